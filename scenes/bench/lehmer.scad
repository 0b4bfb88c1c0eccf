// Lehmer's generator with the multiplier of Park and Miller: products stay below 2^53, so every program that computes in
// doubles gets the same numbers.
lehmer_modulus = 2147483647;
function lehmer_next(state) = state * 16807 % lehmer_modulus;

// `count` numbers in (0, 1) from a seed.
function lehmer(seed, count) =
  [for (i = 0, state = lehmer_next(seed); i < count; i = i + 1, state = lehmer_next(state)) state / lehmer_modulus];
