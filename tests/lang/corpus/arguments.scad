echo("a", b=1, "c");
echo();
echo([1, "a", [undef, true]], x=[0:2]);
echo(each_of = [each [1]]);
echo(1 , 2);
echo(version_num() == 20210100);
