// Commas with nothing between them.
function f(a, b) = [a, b];
echo(1,, 2, , "x");
echo(f(1,, 2), [1,, 2,,]);
