/**
 * Meshes, images and lines as an input that moves and counts, and some of them.
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

/** Data sets, all of one type, that are a function of time. It writes all of its images into the
 * memory of the one before, if VTK lets it. */
class ShapeSource : public vtkAlgorithm
{
public:
  static ShapeSource* New();
  vtkTypeMacro(ShapeSource, vtkAlgorithm);

  using Shape = std::function<vtkSmartPointer<vtkDataSet>(double time)>;
  /** steps: published; none: no time at all. */
  void SetShape(const Shape& shape, const std::vector<double>& steps = {});

  /** The times it was executed for, in order. */
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
};

vtkSmartPointer<ShapeSource> MakeSource(
  const ShapeSource::Shape& shape, const std::vector<double>& steps = {});

/** A ball with its centre on the x axis, as triangles: inside the ball, by .0016 of the radius at
 * most, that is the sum of the sagittas of 64 chords around and of 63 from pole to pole. */
vtkSmartPointer<vtkPolyData> MakeBallMesh(double radius, double x = 0.0);

/** The squared distance to a centre on the x axis, minus that of a ball's surface, in pixels of .05
 * in the box +-1: what vtkSphere gives. */
vtkSmartPointer<vtkImageData> MakeBallImage(double radius, double x = 0.0);

/** Two segments with a joint, and a lone point that is not in a cell, nor a vertex. */
vtkSmartPointer<vtkPolyData> MakeLines();

}

#endif
