// Finds cases whose settings differ but whose pictures have equal pixels. Such a pair usually shows that a
// setting has no effect, for instance a wetness without droplets.
#pragma once
#include <string>
#include <vector>

namespace pelage {

/// The picture of one case.
struct CasePicture {
  std::string name;   ///< name of the case in the text that equal_pictures() returns
  std::string group;  ///< only pictures of one group are compared, for instance those of one variant
  std::string hash;   ///< hash of the pixels; "" if the case has no picture
};

/// Returns a sentence that names up to five sets of cases with equal pictures: "Equal pictures: (dry) and
/// (soaked). The settings in which these cases differ change no pixel."; "" if all differ. Pictures with the
/// same name count as one.
std::string equal_pictures(const std::vector<CasePicture>& pictures);

}  // namespace pelage
