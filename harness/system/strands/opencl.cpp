// Strands on an OpenCL device.
#include <fmt/format.h>

#include "harness/strands/opencl/program_texts.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "harness/system/backend_parts.hpp"
#include "harness/system/strands/backends.hpp"

namespace pelage::strands {
namespace {

class StrandsOnDevice : public OnDevice<StrandInput, Strands, DrawerOptions> {
 public:
  StrandsOnDevice(const BackendOptions& options, const Scene& scene)
      : OnDevice(options, {.mapping = drawing_named(options.mapping)}, scene, expected_programs) {}

  void prepare_frame() override { pipeline_->follow_skin(); }
  std::vector<KeyStrand> keys() { return pipeline_->keys(); }
  void dump(Hdf5File& file, const Scene& scene) override { strands::dump(file, *input_, scene, arrays()); }

  void begin_checks() override {
    step_.before = pipeline_->states();
    step_.number = pipeline_->substep();
    step_.after = pipeline_->states();
    step_.skin = pipeline_->skin_frames();
  }
  std::vector<Check> checks(const Picture& timed, std::uint32_t seed) override {
    std::vector<Check> checks = check_chain_step(*input_, step_, seed);
    StrandFrame frame = arrays();
    frame.picture = timed;
    drawn_ = frame.order.size();
    StrandCheck found = check_strand_frame(*input_, frame, seed);
    agreement_ = found.agreement;
    fragments_ = double(found.fragments);
    for (Check& check : found.checks) checks.push_back(std::move(check));
    return checks;
  }
  void describe(Description& row) override {
    // A strand of a file is its own key strand, and is drawn as one or more curves.
    const std::size_t counted = input_->shapes ? input_->fur.keys.size() : input_->fur.strands.size();
    row.metrics["strands"] = {double(counted), "strands"};
    row.metrics["key_strands"] = {double(input_->fur.keys.size()), "strands"};
    row.metrics["drawn_strands"] = {double(drawn_), "strands"};
    row.metrics["covered_fragments"] = {fragments_, "fragments"};
    add_agreement(row, agreement_);
  }
  std::size_t segments() const override { return 2 * input_->fur.keys.size(); }
  BackendWork work() override { return {fragments_, fragments_, fragments_}; }

  std::string title() const override { return fmt::format("strands on {}", device_.info().name); }

 private:
  /// Returns what the device computed for the last picture.
  StrandFrame arrays() {
    StrandFrame frame{pipeline_->keys(), {}, pipeline_->order(), {}};
    frame.curves = pipeline_->curves();  // overwrites the list that order() returns
    frame.skin = pipeline_->surface();
    return frame;
  }

  ChainStep step_;  ///< the time step before the first timed frame
  Agreement agreement_;
  std::size_t drawn_ = 0;
  double fragments_ = 0;
};

}  // namespace

std::vector<KeyStrand> keys_of(Backend& device) {
  device.still();
  return dynamic_cast<StrandsOnDevice&>(device).keys();
}

std::unique_ptr<Backend> open_opencl(const BackendOptions& options, const Scene& scene) {
  return std::make_unique<StrandsOnDevice>(options, scene);
}

}  // namespace pelage::strands
