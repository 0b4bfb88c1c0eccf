#include "tenon/accel/accelerator.h"

#include "accel/all.h"

namespace tenon {

namespace {

struct Entry {
  std::string_view name;
  Result<std::unique_ptr<Accelerator>> (*build)(const CsgTree&, AcceleratorOptions&);
};

constexpr Entry entries[] = {
#define TENON_ENTRY(function, name, doc) {name, build_##function},
    TENON_ACCELERATORS(TENON_ENTRY)
#undef TENON_ENTRY
};

}  // namespace

std::vector<std::string_view> accelerator_names() {
  std::vector<std::string_view> names;
  for (const Entry& entry : entries) names.push_back(entry.name);
  return names;
}

Result<std::unique_ptr<Accelerator>> build_accelerator(std::string_view spec, const CsgTree& tree) {
  Result<AcceleratorOptions> options = AcceleratorOptions::parse(spec);
  if (!options) return options.error();
  for (const Entry& entry : entries) {
    if (entry.name == options->name()) return entry.build(tree, *options);
  }
  std::string all;
  for (const Entry& entry : entries) all += (all.empty() ? "" : ", ") + std::string(entry.name);
  return Error{ErrorKind::usage, "no accelerator is called '" + options->name() + "'; there is " + all, {}};
}

}  // namespace tenon
