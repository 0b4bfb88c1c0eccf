// A seed gives the same numbers everywhere, and what is drawn later goes on from there.
for (seed = [42, 0, 1.5, -3, -2.25, 1e10, 1e300, 0.1, 123456.789, -1e-5, 2147483647, 2147483648])
  echo(seed, rands(0, 1, 3, seed));
echo(rands(-3, 7, 4));
echo(rands(5, 5, 2, 9), rands(7, -3, 2, 9), rands(0, 1, 0, 9), rands(0, 1, 2.7, 9));
// Where there is no choice no number is drawn.
echo(rands(5, 5, 2, 9), rands(0, 1, 1));
