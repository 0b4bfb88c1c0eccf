surface(file="/tmp/b.dat");
