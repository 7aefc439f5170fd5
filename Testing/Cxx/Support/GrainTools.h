/**
 * Particles with arrays, for tests of the arrays that the skin gets from them.
 */
#ifndef GrainTools_h
#define GrainTools_h

#include "Support/ShapeSource.h"

#include "vtkActiveImplicitSurface.h"
#include "vtkImplicitFunction.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <string>
#include <vector>

namespace activesurface
{

struct Grain
{
  double X, Y, Z;
  int Id;
  double Temperature;
};

/** 60 random grains in a ball of radius 0.4 around (x, 0, 0). */
std::vector<Grain> MakeBlob(double x);

/** Points without cells. Arrays: "id" (int), "temperature" (double, active), "constant" (float,
 * 7.25) and "name" (text, "grain <id>"). */
vtkSmartPointer<vtkPolyData> MakeCloud(const std::vector<Grain>& grains);

void AddFloats(vtkPolyData* points, const char* name, int components, double value);

/** Kernel of particles: a function of q = distance / kernel radius, for q < 1. */
using KernelFormula = double (*)(double);
inline double Wyvill(double q)
{
  return std::pow(1.0 - q * q, 3.0);
}

/** Expected values of the skin at x, from the formula of the kernel. */
struct Expected
{
  double Temperature;
  int Id;
};
Expected FindExpected(
  const std::vector<Grain>& grains, const double x[3], KernelFormula kernel = Wyvill);

/** Names of the skin's point arrays, each followed by the bytes of the array, except for text
 * arrays. */
std::string GetArrayBytes(vtkActiveImplicitSurface* filter);

}

#endif
