// Functions for the datasets of a dump (an HDF5 file with the data of one frame). docs/dump.md lists them.
#pragma once
#include <functional>
#include <type_traits>
#include <vector>

#include "harness/compare/frame_output.hpp"
#include "harness/picture/hdf5_file.hpp"

namespace pelage::dump {

/// Returns one value per element: `value` is a member or a function of the element.
template <class Element, class Value>
auto column(const std::vector<Element>& elements, const Value& value) {
  std::vector<std::remove_cvref_t<std::invoke_result_t<Value, const Element&>>> values;
  values.reserve(elements.size());
  for (const Element& element : elements) values.push_back(std::invoke(value, element));
  return values;
}

void write_camera(Hdf5File& file, const Camera& camera);

}  // namespace pelage::dump
