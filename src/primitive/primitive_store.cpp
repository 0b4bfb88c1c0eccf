#include "tenon/primitive/primitive_store.h"

#include "primitive/lists.h"

namespace tenon {

namespace {

template <class P>
PrimitiveKind describe() {
  const P fallback{};
  PrimitiveKind kind{P::name, P::scad_name, P::doc, P::bounded, false, {}};
  if constexpr (requires { fallback.hull; }) kind.surface = fallback.hull;
  const auto add = [&](const auto& field) {
    kind.fields.push_back({field.name, field.unit, FieldValue(fallback.*field.member), field.doc});
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, P::fields());
  return kind;
}

template <class... P>
std::vector<PrimitiveKind> describe_all(PrimitiveList<P...>) {
  return {describe<P>()...};
}

const std::vector<PrimitiveKind>& all_kinds() {
  static const std::vector<PrimitiveKind> kinds = describe_all(AllPrimitives{});
  return kinds;
}

// Sets a member to a value of its own type.
template <class P, class T>
bool assign(P& primitive, T P::*member, const FieldValue& value) {
  const T* typed = std::get_if<T>(&value);
  if (typed != nullptr) primitive.*member = *typed;
  return typed != nullptr;
}

template <class P>
Result<P> make(std::span<const FieldValue> values) {
  P primitive;
  std::size_t next = 0;
  bool fits = values.size() == std::tuple_size_v<decltype(P::fields())>;
  const auto take = [&](const auto& field) { fits = fits && assign(primitive, field.member, values[next++]); };
  std::apply([&](const auto&... field) { (take(field), ...); }, P::fields());
  if (!fits) return Error{ErrorKind::input, std::string(P::name) + " is given values of the wrong number or type", {}};
  // What follows from the fields is computed once.
  if constexpr (requires { primitive.prepare(); }) primitive.prepare();
  if (std::string problem = primitive.check(); !problem.empty()) return Error{ErrorKind::input, std::move(problem), {}};
  return primitive;
}

}  // namespace

PrimitiveStore::PrimitiveStore() : lists_(std::make_unique<Lists>()) {}
PrimitiveStore::PrimitiveStore(const PrimitiveStore& other) : lists_(std::make_unique<Lists>(*other.lists_)) {}
PrimitiveStore::PrimitiveStore(PrimitiveStore&&) noexcept = default;
PrimitiveStore& PrimitiveStore::operator=(PrimitiveStore&&) noexcept = default;
PrimitiveStore::~PrimitiveStore() = default;

std::span<const PrimitiveKind> PrimitiveStore::kinds() {
  return all_kinds();
}

const PrimitiveKind* PrimitiveStore::find_kind(std::string_view name) {
  for (const PrimitiveKind& kind : all_kinds()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

Result<PrimitiveId> PrimitiveStore::add(const PrimitiveKind& kind, std::span<const FieldValue> values) {
  const auto wanted = static_cast<std::size_t>(&kind - all_kinds().data());
  std::string problem;
  const auto add_to = [&]<std::size_t K>(std::integral_constant<std::size_t, K>) {
    if (K != wanted) return;
    auto& vector = std::get<K>(lists_->vectors);
    using P = typename std::remove_reference_t<decltype(vector)>::value_type;
    Result<P> made = make<P>(values);
    if (!made) {
      problem = made.error().message;
      return;
    }
    lists_->places.push_back({static_cast<std::uint32_t>(K), static_cast<std::uint32_t>(vector.size())});
    vector.push_back(std::move(made).value());
  };
  [&]<std::size_t... K>(std::index_sequence<K...>) {
    (add_to(std::integral_constant<std::size_t, K>{}), ...);
  }
  (std::make_index_sequence<Lists::kind_count>{});
  if (!problem.empty()) return Error{ErrorKind::input, std::move(problem), {}};
  return PrimitiveId{lists_->places.size() - 1};
}

std::size_t PrimitiveStore::size() const {
  return lists_->places.size();
}

const PrimitiveKind& PrimitiveStore::kind(PrimitiveId id) const {
  return all_kinds()[lists_->places[id.get()].kind];
}

std::vector<FieldValue> PrimitiveStore::values(PrimitiveId id) const {
  return visit(*lists_, id, [](const auto& primitive) {
    std::vector<FieldValue> values;
    std::apply([&](const auto&... field) { (values.emplace_back(primitive.*field.member), ...); },
               std::remove_cvref_t<decltype(primitive)>::fields());
    return values;
  });
}

}  // namespace tenon
