echo([for(i=[0:3]) i], [for(i=[3:0]) i], [for(i=[3:-1:0]) i], [for(i=[0:2],j=[0:1]) [i,j]], [for(i="abc") i], [for(i=5) i]);
echo([for(i=0;i<3;i=i+1) i], [for(i=0,a=1;i<5;i=i+1,a=a*2) a], [each [1,2],each [3:5],each "ab",each 7]);
echo([for(i=[0:3]) if(i%2==0) i else -i, for (i=[1,2]) let(j=i*2) each [i,j]]);
echo([for(i=[0:0.1:0.5]) i], [for(i=[0:0.1:1]) i], [for (i=[0:1/3:1]) i], [for(i=[1:-0.25:0]) i], len([for(i=[0:0.01:1]) i]), len([for(i=[0:1/7:1]) i]), len([for(i=[1:-1/3:0]) i]), [for(i=[0:0.1:10]) i][100]);
echo([0:-1:5], [5:1], [0:0.1:1], [0:-0.5:-2], [1:1], [0:1/0], [0:0/0], [0:0:1], ["a":"b"], [0:undef:2]);
echo([for(i=undef) i], [for(i=true) i], [each undef], [each true], [for(i=[]) i], [for(i=[0:-1:3]) i], [each [0:-1:5]]);
echo([for(i=[1,2],i=[3,4]) i]);
echo([for(i=[1:3]) let(j=i*2) if(j>2) j], [for(i=[1:3]) if(i>1) if(i>2) i else -i], [if(true) 1, if(false) 2, 3]);
echo([each each [[1,2],[3]]], [for(i=[0:1]) for(j=[0:1]) i+j, (for(i=[0:1]) i)], [let(a=1) a, let(a=2) each [a,a]]);
echo([1,2,], [,], [1,,2]);
echo([for (i=[0:3], j=i*2) j], [for (i=0,j=10;i<j;i=i+3,j=j-1) [i,j]], [for(i=[0:2]) each [i,[i]]]);
x = let(a=[1,2,3], b=[for(v=a) v*v]) b;
echo(x, [each x, each [for(v=x) v*2]]);
function quicksort(a) = len(a) <= 1 ? a : let(p=a[floor(len(a)/2)])
  concat(quicksort([for(v=a) if(v<p) v]), [for(v=a) if(v==p) v], quicksort([for(v=a) if(v>p) v]));
echo(quicksort([3,1,2,5,4,1,9,0]));
