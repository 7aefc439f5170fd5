// Frames that a running simulation pushes into a filter one by one, as the input of port 0, and the
// times of the frames. Only the newest frame is available.

#ifndef PushedFrames_h
#define PushedFrames_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkTrivialProducer;

namespace activesurface
{

struct SurfaceProperties;

class PushedFrames
{
public:
  explicit PushedFrames(vtkAlgorithm* filter);
  ~PushedFrames();
  PushedFrames(const PushedFrames&) = delete;
  void operator=(const PushedFrames&) = delete;

  // Returns the times of the frames. Discards the times if port 0 is not connected to the frames: a
  // user who connects another input has stopped pushing.
  const std::vector<double>& GetTimes();

  // Returns true if port 0 is connected to the frames.
  bool AreConnected() const;

  // Makes the data the newest frame, dt [pipeline time] after the previous frame, and connects port
  // 0 to the frames. The first frame is at StartTime, and so is the next one if the surface has not
  // reached the first. resumed: times of a loaded state, of which the last becomes the time of the
  // data; otherwise empty. Throws std::invalid_argument for invalid data or dt, and with
  // EQUILIBRIUM; then changes nothing.
  void Push(const SurfaceProperties& properties, vtkDataObject* data, double dt,
    const std::vector<double>& resumed = {});
  // Has to be called when the surface has reached the newest frame.
  void Arrive() { this->HasArrived = true; }
  // Removes the newest frame; the previous frame becomes the newest again.
  void Withdraw();
  // Makes the newest frame the first one.
  void ForgetPast() { this->Times = { this->Times.back() }; }
  // Discards all times; the next frame becomes the first one.
  void Stop()
  {
    this->Times.clear();
    this->HasArrived = false;
  }

private:
  double FindNextTime(const SurfaceProperties& properties, double dt);
  void Show(vtkDataObject* frame);

  vtkAlgorithm* Filter;
  vtkNew<vtkTrivialProducer> Producer;
  vtkSmartPointer<vtkDataObject> Newest;
  vtkSmartPointer<vtkDataObject> Before;
  std::vector<double> Times;
  bool HasArrived = false; // at a frame since the first one
};

}

#endif
