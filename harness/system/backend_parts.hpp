// Functions and base classes that several backends use.
#pragma once
#include <fmt/format.h>

#include "harness/cl/builds.hpp"
#include "harness/system/system.hpp"

namespace pelage {

/// Calls `work` and returns its wall time.
cl::FrameTiming wall_time_of(const std::function<void()>& work);

/// Adds the metrics that help to find the cause of a failed check of the picture.
void add_agreement(Description& row, const Agreement& agreement);

/// Returns opengl_renderer(). Throws CannotDraw if there is no OpenGL.
std::string present_renderer();

/// A backend that computes every picture from the fur at rest.
template <class Input>
class FromRest : public Backend {
 public:
  void load(const SystemInput& input) override {
    input_ = own<Input>(input);
    frames_ = 0;
  }
  bool set_view(const SystemInput& input) override {
    input_ = own<Input>(input);
    return true;
  }
  cl::FrameTiming frame() override {
    ++frames_;
    return still();
  }
  cl::FrameTiming still() override {
    return wall_time_of([this] { draw(); });
  }
  void advance(int frames) override { frames_ += frames; }
  int frames_simulated() const override { return frames_; }

 protected:
  virtual void draw() = 0;  ///< draws the picture after frames_ frames

  std::shared_ptr<const Input> input_;
  int frames_ = 0;
};

/// A backend that computes every frame on an OpenCL device, with the class Pipeline of its system.
template <class Input, class Pipeline, class Options>
class OnDevice : public Backend {
 public:
  using Expected = std::vector<cl::ProgramText>(const cl::Device&, const Scene&, const Options&);
  /// `expected` returns the programs that the pipeline will need.
  OnDevice(const BackendOptions& options, Options own_options, const Scene& scene, Expected& expected)
      : device_(*options.device), options_(std::move(own_options)) {
    if (options.few_pictures)
      ahead_ = std::make_unique<cl::BuildAhead>(device_, expected(device_, scene, options_));
  }
  void load(const SystemInput& input) override {
    pipeline_.reset();  // frees the device's memory first
    input_ = own<Input>(input);
    pipeline_.emplace(device_, input_, options_);
  }
  bool set_view(const SystemInput& input) override {
    if (!pipeline_->set_view(own<Input>(input))) return false;
    input_ = own<Input>(input);
    return true;
  }
  cl::FrameTiming frame() override { return pipeline_->frame(); }
  cl::FrameTiming still() override { return pipeline_->still(); }
  void advance(int frames) override { pipeline_->advance(frames); }
  int frames_simulated() const override { return pipeline_->frames_simulated(); }
  Picture read() override { return pipeline_->read(); }
  std::vector<const cl::Program*> programs() const override { return pipeline_->programs(); }
  std::string device() const override {
    const cl::DeviceInfo& info = device_.info();
    return fmt::format("{}, {} {}", info.name, info.platform, info.driver);
  }

 protected:
  cl::Device device_;
  Options options_;
  std::shared_ptr<const Input> input_;
  std::unique_ptr<cl::BuildAhead> ahead_;
  std::optional<Pipeline> pipeline_;
};

/// A baseline in OpenGL. prepare_frame() computes what the host gives to OpenGL.
template <class Input, class Options>
class InOpenGl : public Backend {
 public:
  explicit InOpenGl(Options options) : renderer_(present_renderer()), options_(std::move(options)) {}
  void prepare_frame() override {
    if (!prepared_) simulate();
    prepared_ = true;
  }
  cl::FrameTiming frame() override {
    prepare_frame();
    prepared_ = false;
    return still();
  }
  int frames_simulated() const override { return frames_; }
  void describe(Description& row) override {
    row.opengl_renderer = renderer_;
    row.opengl_options = to_text(options_);
  }
  std::string device() const override { return renderer_; }

 protected:
  virtual void simulate() = 0;  ///< computes the next frame's input

  std::string renderer_;
  Options options_;
  std::shared_ptr<const Input> input_;
  int frames_ = 0;
  bool prepared_ = false;  ///< the next frame() only draws
};

}  // namespace pelage
