#pragma once

#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "csg/push_attributes.h"
#include "tenon/accel/accelerator.h"
#include "tenon/csg/scene_graph.h"

namespace tenon::fixtures {

/// Builds scene graphs in nested calls.
class SceneBuilder {
 public:
  SceneNodeId primitive(std::string_view kind, const std::vector<FieldValue>& values) {
    const Result<PrimitiveId> id = graph_.primitives.add(*PrimitiveStore::find_kind(kind), values);
    EXPECT_TRUE(id.ok()) << kind;
    return graph_.add({PrimitiveLeaf{*id}, {}});
  }
  /// None when these values make no solid.
  std::optional<SceneNodeId> try_primitive(const PrimitiveKind& kind, const std::vector<FieldValue>& values) {
    const Result<PrimitiveId> id = graph_.primitives.add(kind, values);
    if (!id) return std::nullopt;
    return graph_.add({PrimitiveLeaf{*id}, {}});
  }
  SceneNodeId sphere(double r) { return primitive("sphere", {r}); }
  SceneNodeId cube(const Vec3& size, bool center = false) { return primitive("cube", {size, center}); }
  SceneNodeId box(const Vec3& lower, const Vec3& upper) { return translate(lower, cube(upper - lower)); }
  SceneNodeId cylinder(double h, double r, bool center = false) { return primitive("cylinder", {h, r, center}); }
  SceneNodeId torus(double big, double small) { return primitive("torus", {big, small}); }

  SceneNodeId unite(const std::vector<SceneNodeId>& c) { return graph_.add({SetOperation::union_, c}); }
  SceneNodeId intersect(const std::vector<SceneNodeId>& c) { return graph_.add({SetOperation::intersection, c}); }
  SceneNodeId subtract(const std::vector<SceneNodeId>& c) { return graph_.add({SetOperation::difference, c}); }
  SceneNodeId complement(SceneNodeId c) { return graph_.add({SetOperation::complement, {c}}); }

  SceneNodeId transform(const Affine3& map, SceneNodeId c) { return graph_.add({Transform{map}, {c}}); }
  SceneNodeId translate(const Vec3& v, SceneNodeId c) { return transform(Affine3::translate(v), c); }
  SceneNodeId rotate(const Vec3& degrees, SceneNodeId c) { return transform(Affine3::rotate(degrees), c); }
  SceneNodeId scale(double s, SceneNodeId c) { return transform(Affine3::scale({s, s, s}), c); }
  SceneNodeId color(const Rgba& tint, SceneNodeId c) { return graph_.add({ColorAttribute{tint}, {c}}); }
  SceneNodeId material(std::size_t id, SceneNodeId c) { return graph_.add({MaterialAttribute{MaterialId{id}}, {c}}); }

  SceneNodeId cut_faces(CutFaces show, SceneNodeId c) { return graph_.add({CutFacesAttribute{show}, {c}}); }

  SceneGraph finish(SceneNodeId root) {
    graph_.root = root;
    return std::move(graph_);
  }
  CsgTree tree(SceneNodeId root) {
    Diagnostics diagnostics;
    return push_attributes(finish(root), diagnostics);
  }
  /// With everything that occurs more than once, and can be, stored once.
  CsgTree instanced_tree(SceneNodeId root) {
    Diagnostics diagnostics;
    graph_.root = root;
    const InstancePlan plan = plan_instances(graph_, std::vector<bool>(16), 0);
    return push_attributes(std::move(graph_), diagnostics, plan);
  }

 private:
  SceneGraph graph_;
};

/// One thread's way of asking an accelerator.
class Tracer {
 public:
  explicit Tracer(const CsgTree& tree, std::string_view spec = "none") {
    auto built = build_accelerator(spec, tree);
    EXPECT_TRUE(built.ok()) << spec;
    accelerator_ = std::move(*built);
    context_ = accelerator_->make_context();
  }

  Hit first_hit(const Ray& ray, const Hit* from = nullptr) {
    RayQuery query;
    query.ray = ray;
    query.from = from;
    return accelerator_->first_hit(query, *context_);
  }
  std::vector<SolidSpan> all_spans(const Ray& ray) {
    RayQuery query;
    query.ray = ray;
    std::vector<SolidSpan> spans;
    accelerator_->all_spans(query, spans, *context_);
    return spans;
  }
  const TraversalStatistics& statistics() const { return context_->statistics; }
  const Accelerator& accelerator() const { return *accelerator_; }
  TraceContext& context() { return *context_; }

 private:
  std::unique_ptr<Accelerator> accelerator_;
  std::unique_ptr<TraceContext> context_;
};

}  // namespace tenon::fixtures
