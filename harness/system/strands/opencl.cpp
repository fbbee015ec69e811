// Strands on an OpenCL device.
#include <fmt/format.h>

#include <optional>

#include "harness/cl/build_ahead.hpp"
#include "harness/strands/opencl/program_texts.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "harness/system/backend_parts.hpp"
#include "harness/system/strands/backends.hpp"

namespace pelage::strands {
namespace {

DrawerOptions drawer_options(const BackendOptions& options) {
  DrawerOptions drawer;
  drawer.mapping = drawing_named(options.mapping);
  return drawer;
}

class OnDevice : public Backend {
 public:
  OnDevice(const BackendOptions& options, const Scene& scene)
      : device_(*options.device), options_(drawer_options(options)) {
    if (options.few_pictures)
      ahead_ = std::make_unique<cl::BuildAhead>(device_, expected_programs(device_, scene, options_));
  }

  void load(const SystemInput& input) override {
    strands_.reset();  // frees the device's memory first
    input_ = own<StrandInput>(input);
    strands_.emplace(device_, input_, options_);
  }
  bool set_view(const SystemInput& input) override {
    if (!strands_->set_view(own<StrandInput>(input))) return false;
    input_ = own<StrandInput>(input);
    return true;
  }
  void prepare_frame() override { strands_->follow_skin(); }
  cl::FrameTiming frame() override { return strands_->frame(); }
  cl::FrameTiming still() override { return strands_->still(); }
  void advance(int frames) override { strands_->advance(frames); }
  int frames_simulated() const override { return strands_->frames_simulated(); }
  Picture read() override { return strands_->read(); }
  std::vector<KeyStrand> keys() const { return strands_->keys(); }
  void dump(Hdf5File& file, const Scene& scene) override { strands::dump(file, *input_, scene, arrays()); }

  void begin_checks() override {
    step_.before = strands_->states();
    step_.number = strands_->substep();
    step_.after = strands_->states();
    step_.skin = strands_->skin_frames();
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
    row.metrics["strands"] = {double(input_->fur.strands.size()), "strands"};
    row.metrics["key_strands"] = {double(input_->fur.keys.size()), "strands"};
    row.metrics["drawn_strands"] = {double(drawn_), "strands"};
    row.metrics["covered_fragments"] = {fragments_, "fragments"};
    add_agreement(row, agreement_);
  }
  std::size_t segments() const override { return 2 * input_->fur.keys.size(); }
  BackendWork work() override {
    return {fragments_, fragments_, fragments_};
  }

  std::string title() const override { return fmt::format("strands on {}", device_.info().name); }
  std::vector<const cl::Program*> programs() const override { return strands_->programs(); }
  std::string device() const override { return label_of(device_); }

 private:
  /// Returns what the device computed for the last picture.
  StrandFrame arrays() {
    StrandFrame frame{strands_->keys(), {}, strands_->order(), {}};
    frame.curves = strands_->curves();  // overwrites the list that order() returns
    frame.skin = strands_->surface();
    return frame;
  }

  cl::Device device_;
  std::shared_ptr<const StrandInput> input_;
  DrawerOptions options_;
  std::unique_ptr<cl::BuildAhead> ahead_;
  std::optional<Strands> strands_;
  ChainStep step_;  ///< the time step before the first timed frame
  Agreement agreement_;
  std::size_t drawn_ = 0;
  double fragments_ = 0;
};

}  // namespace

std::vector<KeyStrand> keys_of(Backend& device) {
  device.still();
  return dynamic_cast<OnDevice&>(device).keys();
}

std::unique_ptr<Backend> open_opencl(const BackendOptions& options, const Scene& scene) {
  return std::make_unique<OnDevice>(options, scene);
}

}  // namespace pelage::strands
