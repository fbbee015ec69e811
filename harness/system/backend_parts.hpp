// Functions and a base class that several backends use.
#pragma once
#include "harness/system/system.hpp"

namespace pelage {

/// Calls `work` and returns its wall time.
cl::FrameTiming wall_time_of(const std::function<void()>& work);

/// Adds the metrics that help to find the cause of a failed check of the picture.
void add_agreement(Description& row, const Agreement& agreement);

/// Returns the names of the device and of its driver.
std::string label_of(const cl::Device& device);

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

}  // namespace pelage
