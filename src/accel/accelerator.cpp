#include "tenon/accel/accelerator.h"

#include "accel/all.h"

namespace tenon {

namespace {

struct Entry {
  std::string_view name;
  std::string_view variants;
  std::string_view doc;
  Result<std::unique_ptr<Accelerator>> (*build)(const BuildInput&, AcceleratorOptions&);
};

constexpr Entry entries[] = {
#define TENON_ENTRY(function, name, variants, doc) {name, variants, doc, build_##function},
    TENON_ACCELERATORS(TENON_ENTRY)
#undef TENON_ENTRY
};

}  // namespace

void Accelerator::first_boundaries(std::span<const RayQuery> queries, std::span<RayBoundary> boundaries,
                                   TraceContext& context) const {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Hit hit = first_hit(queries[i], context);
    boundaries[i] = {hit.t, hit.surface, hit.entering};
  }
}

void Accelerator::occluded(std::span<const RayQuery> queries, std::span<std::uint8_t> answers,
                           TraceContext& context) const {
  const auto stops = [](const Hit&) { return true; };
  for (std::size_t i = 0; i < queries.size(); ++i) answers[i] = any_hit(queries[i], stops, context);
}

std::vector<std::string_view> accelerator_names() {
  std::vector<std::string_view> names;
  for (const Entry& entry : entries) names.push_back(entry.name);
  return names;
}

std::string_view accelerator_doc(std::string_view name) {
  for (const Entry& entry : entries) {
    if (entry.name == name) return entry.doc;
  }
  return {};
}

std::vector<std::string> accelerator_specs() {
  std::vector<std::string> specs;
  for (const Entry& entry : entries) {
    specs.emplace_back(entry.name);
    std::string_view rest = entry.variants;
    while (!rest.empty()) {
      const std::size_t end = rest.find(';');
      specs.push_back(std::string(entry.name) + ':' + std::string(rest.substr(0, end)));
      rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    }
  }
  return specs;
}

Result<std::unique_ptr<Accelerator>> build_accelerator(std::string_view spec, const CsgTree& tree,
                                                       const ScreenView* view) {
  Result<AcceleratorOptions> options = AcceleratorOptions::parse(spec);
  if (!options) return options.error();
  for (const Entry& entry : entries) {
    if (entry.name == options->name()) return entry.build({tree, view}, *options);
  }
  std::string all;
  for (const Entry& entry : entries) all += (all.empty() ? "" : ", ") + std::string(entry.name);
  return Error{ErrorKind::usage, "no accelerator is called '" + options->name() + "'; there is " + all, {}};
}

}  // namespace tenon
