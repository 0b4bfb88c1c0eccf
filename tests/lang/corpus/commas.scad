// Commas with nothing between them.
function f(a,, b) = [a, b];
module m(a,, b) echo(a, b);
g = function(,a,, b) a + b;
echo(1,, 2, , "x");
echo(, f(1,, 2), [1,, 2,,]);
m(, 3,, 4);
echo(g(5,, 6));
