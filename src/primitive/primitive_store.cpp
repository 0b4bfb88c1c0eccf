#include "tenon/primitive/primitive_store.h"

#include "primitive/field_values.h"
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

template <class... P, class... Q>
std::vector<PrimitiveKind> describe_all(PrimitiveList<P...>, PrimitiveList<Q...>) {
  return {describe<P>()..., describe<Q>()...};
}

// Those that a scene may name come first.
const std::vector<PrimitiveKind>& all_kinds() {
  static const std::vector<PrimitiveKind> kinds = describe_all(AllPrimitives{}, MadePrimitives{});
  return kinds;
}

template <class... P>
constexpr std::size_t count_of(PrimitiveList<P...>) {
  return sizeof...(P);
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
  return std::span(all_kinds()).first(count_of(AllPrimitives{}));
}

const PrimitiveKind* PrimitiveStore::find_kind(std::string_view name) {
  for (const PrimitiveKind& kind : kinds()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

Result<PrimitiveId> PrimitiveStore::add(const PrimitiveKind& kind, std::span<const FieldValue> values) {
  const auto wanted = static_cast<std::size_t>(&kind - all_kinds().data());
  const std::uint64_t hash = hash_of(values);
  const std::optional<std::uint32_t> known = lists_->by_values.find(hash, [&](std::uint32_t i) {
    return lists_->places[i].kind == wanted && are_equal(this->values(PrimitiveId{i}), values);
  });
  if (known) return PrimitiveId{*known};
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
  const auto added = static_cast<std::uint32_t>(lists_->places.size() - 1);
  lists_->by_values.note(hash, added);
  return PrimitiveId{added};
}

PrimitiveId PrimitiveStore::add_instance(std::shared_ptr<const CompositeSolid> solid) {
  auto& instances = std::get<std::vector<Instance>>(lists_->vectors);
  lists_->places.push_back(
      {static_cast<std::uint32_t>(count_of(AllPrimitives{})), static_cast<std::uint32_t>(instances.size())});
  instances.push_back({std::move(solid)});
  return PrimitiveId{lists_->places.size() - 1};
}

PrimitiveId PrimitiveStore::add_copy(const PrimitiveStore& from, PrimitiveId id) {
  visit(*from.lists_, id, [&](const auto& primitive) {
    auto& own = std::get<std::vector<std::remove_cvref_t<decltype(primitive)>>>(lists_->vectors);
    lists_->places.push_back({from.lists_->places[id.get()].kind, static_cast<std::uint32_t>(own.size())});
    own.push_back(primitive);
  });
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
