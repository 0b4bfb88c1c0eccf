use <used.scad>
include <included.scad>
module chain() { echo(used_function(10)); included_module(); }
