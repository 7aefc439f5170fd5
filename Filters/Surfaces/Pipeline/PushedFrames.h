// Frames that a running simulation pushes into a filter one by one, as the input of port 0, and
// their times. Only the newest one is there.

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

  // None while something else is the filter's input: whoever connects it does not push any more.
  const std::vector<double>& GetTimes();

  // Whether the frames are the filter's input.
  bool AreConnected() const;

  // Makes the data the newest frame, dt after the one before, and the frames the filter's input.
  // The arrays are shared. Throws std::invalid_argument for what cannot be; then all is as before.
  void Push(const SurfaceProperties& properties, vtkDataObject* data, double dt);
  // Puts the frame before the newest one back.
  void Withdraw();
  // The newest frame is the first one.
  void ForgetPast() { this->Times = { this->Times.back() }; }
  // The next frame is the first one.
  void Stop() { this->Times.clear(); }

private:
  double FindNextTime(const SurfaceProperties& properties, double dt);
  void Show(vtkDataObject* frame);

  vtkAlgorithm* Filter;
  vtkNew<vtkTrivialProducer> Producer;
  vtkSmartPointer<vtkDataObject> Newest;
  vtkSmartPointer<vtkDataObject> Before;
  std::vector<double> Times;
};

}

#endif
