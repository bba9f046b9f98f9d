// Makes one visitor of a variant from several lambdas.
#pragma once

namespace gearlash {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace gearlash
