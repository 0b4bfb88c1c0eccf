for (i=[1,2], j=[i:3]) echo(i, j);
for (i=5) echo("num", i);
for (i=undef) echo("undef", i);
for (i="ab") echo("str", i);
for (i=[]) echo("never");
for (i=[1,2], j=["a","b"]) { k = str(i,j); echo(k); }
for (i=[[1,2],[3,4]]) echo(i[0], i.y);
for (i=[1:2]) for (j=[i:2]) echo(i, j);
for (i=3, j=[1,2]) echo(i, j);
for () echo("none");
for ([1,2]) echo("pos");
for ($i=[0:1]) echo($i);
for (i=[0:-1:3]) echo(i);
for (i=[3:1]) echo(i);
intersection_for (i=[1:2], j=[1:2]) echo(i, j);
intersection_for (i=[1:3]) { echo(i); x = i; translate([i,0,0]) sphere(x); }
