#include "harness/subjects/fewer_layers.hpp"

#include <fmt/format.h>

#include "harness/error.hpp"
#include "harness/measure/turns.hpp"

namespace pelage {
std::unique_ptr<Subject> fewer_layers(const MakeSubject& make, const Case& which, int layers) {
  if (layers < 4 || layers % 4 != 0)
    throw InputError(
        fmt::format("{}: fur.layers is {}; give a multiple of 4, because {} also draws pictures with half "
                    "and with a quarter of the layers",
                    which.name, layers, which.pipeline));
  const auto with = [&](int number) {
    Case fewer = which;
    fewer.set.emplace_back("fur.layers", std::to_string(number));
    return make(fewer);
  };
  std::vector<Turn> others;
  others.push_back({"half", with(layers / 2)});
  others.push_back({"quarter", with(layers / 4)});
  return std::make_unique<Turns>(with(layers), std::move(others),
                                 TurnRules{.check = own_checks, .frame_over = true});
}

}  // namespace pelage
