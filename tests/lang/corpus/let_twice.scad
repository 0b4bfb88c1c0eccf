// Of names that a let() sets twice, the first value holds; special ones, too.
$a = 1;
b = 1;
echo(let ($a = 2, b = 3, $a = 4) [$a, b], let ($a = 2, b = 3, b = 5) [$a, b], let ($a = b, b = $a) [$a, b]);
