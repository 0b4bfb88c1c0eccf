echo("a\"b\\n\n", "é", "\t\r\x41\u00e9\U01f600\'", "tab	x", "\q \x80 \x7f \u12 end");
f = function(x) x;
echo(f, str(f), str("a",[1,"b"]), str(1.0), str("a",1.0,undef,[0:2],true,"q\"q"));
echo(str(), str([1,"a",["b"]]), str("x"), str(undef,true), str([1.5,"x",[undef]]), str(1e10), str(-0), str([]), str([[]]), str(""));
echo(chr(65), chr([66,67]), chr([65:70]), chr(0), chr(-1), chr(1e9), chr("a"), chr(65,66), chr([[65]]), chr(128512));
echo(chr([65,"b",66]), chr([]), chr(65.7), chr(8364), chr(55296), chr(1114112), chr());
echo(ord("A"), ord(""), ord(5), ord("é"), ord("abc"), ord(undef), ord("€"), ord("ab"), [for (c = "é😀") ord(c)]);
echo(len("é"), len([1,2]), len(5), len(""), len([]), len("日本"), len([0:2]), len(true), len(undef), len("a"+1));
