a = 5;
module s() { a = 6; echo(a); { b = 7; } echo(b); }
s();
echo(a);
x = 1;
y = x;
echo(x, y);
x = 2;
p = q;
q = 3;
echo(p, q);
module late() { echo(zz); zz = 3; }
late();
echo(ww);
{ ww = 1; }
if (true) { vv = 1; echo(vv); }
echo(vv);
module inner_function(x) { function g() = x; echo(g()); }
inner_function(4);
$d = 3;
module outer() { echo($d); $d = 2; inner(); }
module inner() { echo($d); }
outer();
inner();
let (c=1, d=c) { echo(c, d); }
let () echo("e");
let ($fn=3) echo($fn);
module m() { echo(a); let(a=2) echo(a); }
m();
assign(q=4) echo(q);
module defaults(a, b=a) { echo(a, b); }
defaults(3);
module special($x=1) { n(); }
module n() { echo($x); }
special();
special(4);
echo($fn, $fa, $fs, $t, PI);
module d() { echo($fn, $fa, $fs); }
d($fn=7);
let($fn=9) d();
first = echo("first") 1;
second = echo("second") 2;
first = echo("third") 3;
