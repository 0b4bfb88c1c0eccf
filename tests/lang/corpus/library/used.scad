echo("the top level of a used file is not run");
used_value = 5;
$fn = 33;
function used_function(x) = used_value + x;
module used_module() { echo("used", used_value, $fn, $foo); sphere(1); }
cube(99);
