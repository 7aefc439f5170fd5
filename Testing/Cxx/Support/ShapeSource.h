/**
 * A source of time-dependent meshes, images and lines that counts its executions, and some shapes.
 */
#ifndef ShapeSource_h
#define ShapeSource_h

#include "vtkAlgorithm.h"
#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkActiveImplicitSurface;
class vtkImageData;
class vtkPolyData;

namespace activesurface
{

/** Source of data sets of one type that depend on time. The source writes each image into the
 * memory of the one before, if VTK permits. */
class ShapeSource : public vtkAlgorithm
{
public:
  static ShapeSource* New();
  vtkTypeMacro(ShapeSource, vtkAlgorithm);

  using Shape = std::function<vtkSmartPointer<vtkDataSet>(double time)>;
  /** `steps`: time steps to publish. If empty, the source publishes no time. */
  void SetShape(const Shape& shape, const std::vector<double>& steps = {});
  /** While set, executions fail. */
  void SetFailing(bool failing) { this->Failing = failing; }

  /** Times of all executions, in order. */
  std::vector<double> Executions;
  std::string GetExecutions() const;

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

protected:
  ShapeSource();
  int FillOutputPortInformation(int port, vtkInformation* info) override;

private:
  void MakeOutput(vtkInformation* out);
  void PublishTimes(vtkInformation* out);
  void Execute(vtkInformation* out);

  Shape Shapes;
  std::vector<double> Steps;
  bool Failing = false;
};

vtkSmartPointer<ShapeSource> MakeSource(
  const ShapeSource::Shape& shape, const std::vector<double>& steps = {});

/** A ball with its centre on the x axis, as triangles. The mesh lies inside the ball by at most
 * 0.0016 of the radius, the sum of the sagittas of 64 chords around and of 63 from pole to pole. */
vtkSmartPointer<vtkPolyData> MakeBallMesh(double radius, double x = 0.0);

/** Squared distance to a centre on the x axis, minus the squared radius, in pixels of 0.05 in the
 * box +-1: the values of vtkSphere. */
vtkSmartPointer<vtkImageData> MakeBallImage(double radius, double x = 0.0);

/** Two segments with a joint, and an isolated point that belongs to no cell. */
vtkSmartPointer<vtkPolyData> MakeLines();

}

#endif
