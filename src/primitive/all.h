#pragma once

#include "primitive/algebraic.h"
#include "primitive/bicubic.h"
#include "primitive/box.h"
#include "primitive/cone.h"
#include "primitive/convex_polyhedron.h"
#include "primitive/cylinder.h"
#include "primitive/half_space.h"
#include "primitive/hyperboloid.h"
#include "primitive/instance.h"
#include "primitive/mesh.h"
#include "primitive/paraboloid.h"
#include "primitive/polygon3d.h"
#include "primitive/prism.h"
#include "primitive/quadric.h"
#include "primitive/revolution.h"
#include "primitive/sphere.h"
#include "primitive/torus.h"
#include "primitive/truncated_cone.h"
#include "primitive/twisted_prism.h"

namespace tenon {

template <SolidPrimitive... P>
struct PrimitiveList {};

/// Every kind of primitive, in the order of PrimitiveStore::kinds(). For the dispatch unit and the store only.
using AllPrimitives =
    PrimitiveList<Sphere, Box, Cylinder, Cone, Torus, Hyperboloid, Paraboloid, HalfSpace, ConvexPolyhedron, Prism,
                  Revolution, TwistedPrism, Mesh, Quadric, TruncatedCone, Algebraic, Polygon3d, Bicubic>;

/// What a store holds beside them, which no scene names: the compiler makes it.
using MadePrimitives = PrimitiveList<Instance>;

}  // namespace tenon
