module m(a, b=2) { echo(a, b, $children, parent_module(0)); children(); }
m(1) cube();
m(b=5, c=6) { cube(); sphere(); }
module p() { echo($foo=$foo, $children); for (i=[0:1:$children-1]) children(i); children([0,1]); children(-1); children(99); }
p($foo=3) { echo("c0",$foo); echo("c1"); }
p() {}
p();
p() { if (true) cube(); for (i=[0:1]) cube(); ; x=1; { cube(); cube(); } }
module a() { module b() { children(); echo("b",$children); } b() echo("x"); b(); }
a() { echo("y"); echo("z"); }
module d() { echo("d",$children); children(); }
module c() { d() { echo("in",$children); children(); } }
c() { echo("q1"); echo("q2"); echo("q3"); }
module r() { children([0:1]); children([0,1]); children([0:2:3]); children("a"); children(undef); children(0.7); }
r() { echo(0); echo(1); echo(2); echo(3); }
module hides() { x=5; children(); }
x = 3;
hides() echo(x);
module shows() { for (i=[0:1]) { $x=i; children(); } }
shows() echo($x);
module first() { second(); }
module second() { echo(parent_module(1), parent_module(0), $parent_modules); }
first();
module nested() { module y() { echo("y"); } y(); }
nested();
module count(n=3) { if (n>0) { echo(n); count(n-1); } }
count();
module twice(a, a2) { echo(a, a2); }
twice(a=1, a=2);
twice(1, a=3, 2);
module one() echo("one-line");
one();
if (undef) echo("t"); else echo("f");
if (1) {} else echo("f");
if (0) echo(1); else { echo(2); echo(3); }
if (1) echo("a"); else if (2) echo("b");
if (false) echo(1); else if (true) echo("elseif");
*echo("no");
#echo("hash");
%echo("perc");
union() { echo("in union"); }
