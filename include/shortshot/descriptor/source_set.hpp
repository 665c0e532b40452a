// shortshot/descriptor/source_set.hpp: where the values of a descriptor's signals come from, all of them in one object.
#ifndef SHORTSHOT_DESCRIPTOR_SOURCE_SET_HPP
#define SHORTSHOT_DESCRIPTOR_SOURCE_SET_HPP

#include <type_traits>

#include "../cloud/cloud.hpp"
#include "../config.hpp"

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// The kinds of sources that a signal reads, in the order in which measure() gets them.
template <class... Kinds>
struct SourceKinds {};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Some sources, by value: what sources() makes.
template <class... Sources>
struct SourceSet {};
template <class First, class... Others>
struct SourceSet<First, Others...> {
  First first;                  ///< one of them
  SourceSet<Others...> others;  ///< the rest
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The sources of a descriptor's signals, in any order: `sources(LabColors{...}, CloudNormals(cloud))`, or `sources()`
/// for one that reads none.
[[nodiscard]] inline extend::SourceSet<> sources() noexcept { return {}; }
template <class First, class... Others>
[[nodiscard]] extend::SourceSet<First, Others...> sources(const First& first, const Others&... others) noexcept {
  return {first, sources(others...)};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// May a source be read where a signal asks for one of this kind? One of the kind itself, or of a class derived from
/// it, or what the kind accepts().
template <class Kind, class Source, class = void>
struct StandsFor : std::is_base_of<Kind, Source> {};
template <class Kind, class Source>
struct StandsFor<Kind, Source, std::void_t<decltype(Kind::template accepts<Source>())>>
    : std::bool_constant<std::is_base_of<Kind, Source>::value || Kind::template accepts<Source>()> {};

template <class Kind, class... Sources>
inline constexpr bool has_source = (StandsFor<Kind, Sources>::value || ...);

/// The first source of a set that stands for a kind; there must be one.
template <class Kind, class First, class... Others>
[[nodiscard]] constexpr const auto& source_of(const extend::SourceSet<First, Others...>& set) noexcept {
  if constexpr (StandsFor<Kind, First>::value || sizeof...(Others) == 0) {
    return set.first;
  } else {
    return source_of<Kind>(set.others);
  }
}

/// Is there one for each of these kinds?
template <class... Kinds, class... Sources>
constexpr bool has_sources(extend::SourceKinds<Kinds...>, const extend::SourceSet<Sources...>*) noexcept {
  return (has_source<Kinds, Sources...> && ...);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// Kinds of sources, each once.
template <class Have, class... Lists>
struct DistinctKinds {
  using type = Have;
};
template <class... Have, class... Others>
struct DistinctKinds<extend::SourceKinds<Have...>, extend::SourceKinds<>, Others...>
    : DistinctKinds<extend::SourceKinds<Have...>, Others...> {};
template <class... Have, class Next, class... More, class... Others>
struct DistinctKinds<extend::SourceKinds<Have...>, extend::SourceKinds<Next, More...>, Others...>
    : DistinctKinds<std::conditional_t<(std::is_same<Have, Next>::value || ...), extend::SourceKinds<Have...>,
                                       extend::SourceKinds<Have..., Next>>,
                    extend::SourceKinds<More...>, Others...> {};

/// The channel of a cloud that a kind of source reads; a kind that names none reads something of its owner's.
template <class Kind, class = void>
inline constexpr Channel channel_of = Channel::own;
template <class Kind>
inline constexpr Channel channel_of<Kind, std::void_t<decltype(Kind::channel)>> = Kind::channel;

template <class... Kinds>
[[gnu::always_inline]] constexpr bool reads_channel(extend::SourceKinds<Kinds...>,
                                                    [[maybe_unused]] Channel channel) noexcept {
  return ((channel_of<Kinds> == channel) || ...);
}

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

#endif  // SHORTSHOT_DESCRIPTOR_SOURCE_SET_HPP
