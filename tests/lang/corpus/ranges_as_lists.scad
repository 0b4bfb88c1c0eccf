// A range of nothing is like every other, and less than one of something; a step of zero leads nowhere.
empty = [[1 : -1 : 3], [-1 : -1 : 1], [5 : 1 : 1]];
some = [1 : 2];
echo([for (a = empty, b = empty) a == b]);
echo([for (a = empty) [a < some, a > some, a == some, a <= some]]);
for (i = [0 : 0 : 0]) echo("never", i);
for (i = [1 : 0 : 5]) echo("never", i);
echo([for (i = [1 : 0 : 5]) i]);
// Where ranges are no lists of nothing, their numbers count, not where their ends were written.
echo([0 : 2 : 4] == [0 : 2 : 5], [1 : -1 : -1] < [1 : -1 : -2], [1 : 3] > [1 : 2], [0 : 3] < [1 : 2]);
// What has no step has its begin alone.
for (i = [3 : 1 / 0 : 4]) echo(i);
