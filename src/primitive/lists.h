#pragma once

#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "primitive/all.h"
#include "tenon/base/hash_index.h"

namespace tenon {

template <class Named, class Made>
struct VectorsOf;
template <class... P, class... Q>
struct VectorsOf<PrimitiveList<P...>, PrimitiveList<Q...>> {
  using type = std::tuple<std::vector<P>..., std::vector<Q>...>;
};

/// One vector per kind, and where in them each primitive lies.
struct PrimitiveStore::Lists {
  struct Place {
    std::uint32_t kind;
    std::uint32_t index;
  };

  VectorsOf<AllPrimitives, MadePrimitives>::type vectors;
  std::vector<Place> places;
  HashIndex by_values;  // of what add() was given

  static constexpr std::size_t kind_count = std::tuple_size_v<decltype(vectors)>;
};

/// Calls visitor(primitive) with the primitive's own type: one switch over the kinds.
template <class Visitor>
auto visit(const PrimitiveStore::Lists& lists, PrimitiveId id, Visitor&& visitor) {
  using Result = decltype(visitor(std::get<0>(lists.vectors)[0]));
  const PrimitiveStore::Lists::Place place = lists.places[id.get()];
  const auto from = [&]<std::size_t K>(auto&& self, std::integral_constant<std::size_t, K>) -> Result {
    if constexpr (K + 1 < PrimitiveStore::Lists::kind_count) {
      if (place.kind != K) return self(self, std::integral_constant<std::size_t, K + 1>{});
    }
    return visitor(std::get<K>(lists.vectors)[place.index]);
  };
  return from(from, std::integral_constant<std::size_t, 0>{});
}

}  // namespace tenon
