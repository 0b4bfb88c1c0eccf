// The bare bunny, by either structure over its triangles: for `./dev bench bunny`.
local = "bvh";

import("../../build/bunny.off", local = local);
