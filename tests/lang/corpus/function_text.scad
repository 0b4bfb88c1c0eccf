// How function values are shown.
echo(function(x) x+1, function(x,y=2) let(z=3) [for(i=[0:x]) i*y+z]);
echo(function(x) x ? 1 : 2, function() "a\n\"b", function(a) a.x, function(a) a[0](1,b=2), function(a) !a, function(a) -a^2, function(a) [1:2:3], function(a) [1:2], function(a) [1,[2]]);
echo(function(a) echo(a) 1, function(a) assert(a,"m") 1, function(a) let(b=1,c=2) b, function(a) [each a], function(a) [for(i=0;i<1;i=i+1) i], function(a) [if(a) 1 else 2], function(a) [if(a) 1], function(a) [let(b=1) b], function(a) function(b) a);
echo(function(a=1,b) 1, function(a) undef, function(a) true && 1 || 2, function(a) 1%2, function(a) 1e10, function(a) +a, function($fn) $fn, function(a) [for(i=a) for(j=i) j], function(a) [for(i=a) each i]);
echo(function(a) [for(i=a) i], function(a) [for(i=a) (i)], function(a) [let(b=1) b+1], function(a) [let(b=1) for(i=b) i], function(a) [for(i=a) let(b=i) b], function(a) [for(i=0;i<1;i=i+1) for(j=i) i], function(a) [if(a) for(i=a) i]);
echo(function(a) -(-a), function(a) !(a), function(a) (a+1).x, function(a) (a?1:2)[0], function(a) a(1)(2), function(a) a.x(1), function(a) (function(x) x)(a), function(a) "tab\té\\");
