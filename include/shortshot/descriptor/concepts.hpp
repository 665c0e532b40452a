// shortshot/descriptor/concepts.hpp: what a signal and a voting rule must have. C++17 knows no concepts; these are
// asked in static_asserts, so that who leaves something out reads one sentence.
#ifndef SHORTSHOT_DESCRIPTOR_CONCEPTS_HPP
#define SHORTSHOT_DESCRIPTOR_CONCEPTS_HPP

#include <type_traits>
#include <utility>

#include "../base/simd.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "axis.hpp"
#include "signals.hpp"
#include "voting.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// Can a signal be measured, given one source of each kind?
template <class Signal, class At, class Kinds, class = void>
struct IsMeasurable : std::false_type {};
template <class Signal, class At, class... Kinds>
struct IsMeasurable<Signal, At, extend::SourceKinds<Kinds...>,
                    std::void_t<decltype(Signal::measure(std::declval<const At&>(), std::declval<const Kinds&>()...))>>
    : std::is_same<decltype(Signal::measure(std::declval<const At&>(), std::declval<const Kinds&>()...)),
                   extend::simd::F32> {};

template <class Signal, class = void>
struct IsSignal : std::false_type {};
template <class Signal>
struct IsSignal<Signal,
                std::void_t<decltype(Signal::has_histogram), decltype(Signal::bins), decltype(Signal::reads_index_only),
                            typename Signal::Measured, typename Signal::Rule, typename Signal::Sources>>
    : std::bool_constant<
          !Signal::has_histogram ||
          IsMeasurable<Signal,
                       std::conditional_t<Signal::reads_index_only, extend::IndicesAt, extend::NeighborsAt<Frame>>,
                       typename Signal::Sources>::value> {};

template <class Voting, class = void>
struct IsVotingRule : std::false_type {};
template <class Voting>
struct IsVotingRule<Voting, std::void_t<decltype(Voting::weight_bits),
                                        decltype(Voting::template combine<4>(std::declval<const extend::Axis (&)[4]>(),
                                                                             std::declval<const extend::Share (&)[4]>(),
                                                                             std::declval<const extend::VoteUnit&>()))>>
    : std::bool_constant<
          std::is_same<decltype(Voting::split(std::declval<const extend::Axis&>(), std::declval<extend::simd::I32>(),
                                              std::declval<const extend::VoteUnit&>())),
                       extend::Share>::value &&
          std::is_same<decltype(Voting::template combine<4>(std::declval<const extend::Axis (&)[4]>(),
                                                            std::declval<const extend::Share (&)[4]>(),
                                                            std::declval<const extend::VoteUnit&>())),
                       extend::Votes<Voting::template votes<4>>>::value> {};

/// Does an axis' partner get that axis' share alone, so that parts on one grid have such votes in common? A rule that
/// does not say so has nothing in common.
template <class Voting, class = void>
struct PartnersGetOwnShare : std::false_type {};
template <class Voting>
struct PartnersGetOwnShare<Voting, std::void_t<decltype(Voting::partners_get_own_share)>>
    : std::bool_constant<Voting::partners_get_own_share> {};

/// Does a rule vote for a cell and its partners, and say so?
template <class Voting, class = void>
struct VotesForPartners : std::false_type {};
template <class Voting>
struct VotesForPartners<Voting, std::void_t<decltype(Voting::votes_for_partners)>>
    : std::bool_constant<Voting::votes_for_partners> {};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

#endif  // SHORTSHOT_DESCRIPTOR_CONCEPTS_HPP
