// What comes out even: whole degrees go through a function and its inverse, and roots are those of sqrt().
echo([for (a = [-90 : 90]) if (asin(sin(a)) != a) a]);
echo([for (a = [0 : 180]) if (acos(cos(a)) != a) a]);
echo([for (a = [-90 : 90]) if (atan(tan(a)) != a) a]);
echo([for (a = [-179 : 179]) if (atan2(sin(a), cos(a)) != a) a]);
echo(tan(30) == sqrt(3) / 3, tan(-150) == sqrt(3) / 3, tan(150) == -sqrt(3) / 3, tan(60) == sqrt(3));
echo(1 / tan(180), 1 / tan(0), 1 / tan(-180));
