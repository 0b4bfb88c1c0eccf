use <library/used.scad>
include <library/included.scad>
use <library/chain.scad>
first_value = 10;
echo(used_function(1));
used_module($foo=2);
echo(used_value);
echo($fn);
included_module();
chain();
x = [1, include <library/five.inc>
];
echo(x);
module inside() { include <library/included.scad> included_module(); }
inside();
/* [Customizer] */
width = 3; // [1:10]
echo(width); // comment /* in comment
/* echo("no") // */ echo("yes");
