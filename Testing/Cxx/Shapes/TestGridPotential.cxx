// vtkGridPotential of an image: the trilinear function and its box.

#include "Support/GridShapes.h"

#include "Grid/GridSamples.h"

#include "vtkImplicitBoolean.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestGridPotential
{

// 1e-12 is ample for 30 roundings of numbers up to 100. Spacing multiplies the error of the
// gradient by up to 4.
TEST(TestGridPotential, LinearFieldsAreExactForAllTypes)
{
  const int types[] = { VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT,
    VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG,
    VTK_FLOAT, VTK_DOUBLE, VTK_ID_TYPE };
  for (const bool isTurned : { false, true })
  {
    const Place place(isTurned);
    const Point slope = place.Turn({ 2.0, 3.0, 5.0 });
    for (const int type : types)
    {
      vtkNew<vtkGridPotential> potential;
      potential->SetInput(MakeImage(place, type, Linear));
      potential->SetIsoValue(30.0);
      Random random(1);
      const std::string name = vtkImageScalarTypeNameMacro(type);
      for (int n = 0; n < 100; ++n)
      {
        const Point pixel = PixelIn(place, random);
        const double value = Linear(pixel[0], pixel[1], pixel[2]) - 30.0;
        EXPECT_NEAR(ValueAt(potential, place.At(pixel)), value, 1e-12) << name << ": value";
        const Point gradient = GradientAt(potential, place.At(pixel));
        EXPECT_LT(Distance(gradient, slope), 1e-11) << name << ": gradient";
      }
    }
  }
}

// Rounding might put the nodes of the faces outside.
TEST(TestGridPotential, NodesHaveTheirSamples)
{
  for (const bool isTurned : { false, true })
  {
    Place place(isTurned);
    place.Origin = { 1.1e4, -0.3, 0.7 };
    place.Spacing = { 0.1, 0.3, 0.7 };
    vtkNew<vtkGridPotential> potential;
    potential->SetInput(MakeImage(place, VTK_INT, Linear));
    const auto& e = place.Extent;
    // The rounding of coordinates of 1e4 is 2e-12, or 2e-11 pixels. The slope is 2 per pixel.
    for (int i = e[0]; i <= e[1]; ++i)
    {
      for (int j = e[2]; j <= e[3]; ++j)
      {
        const Point low = { double(i), double(j), double(e[4]) };
        const Point high = { double(i), double(j), double(e[5]) };
        EXPECT_NEAR(ValueAt(potential, place.At(low)), Linear(i, j, e[4]), 1e-9) << "lowest plane";
        EXPECT_NEAR(ValueAt(potential, place.At(high)), Linear(i, j, e[5]), 1e-9)
          << "highest plane";
      }
    }
  }
}

// All samples are inside, so the box is a body.
TEST(TestGridPotential, OutsideIsTheDistanceToTheBox)
{
  for (const bool isTurned : { false, true })
  {
    const Place place(isTurned);
    vtkNew<vtkGridPotential> potential;
    potential->SetInput(MakeImage(place, VTK_FLOAT, [](double, double, double) { return -7.0; }));
    EXPECT_EQ(ValueAt(potential, place.At({ 4.0, 0.0, 12.0 })), -7.0) << "in the box";
    // A pixel has the size 0.5 x 0.25 x 2.
    const auto expect = [&](const Point& pixel, double distance, const Point& away)
    {
      EXPECT_NEAR(ValueAt(potential, place.At(pixel)), distance, 1e-12) << "distance";
      // Turn expects a gradient per pixel: the slope along each axis times the pixel's length.
      const Point by = { 0.5 * away[0], 0.25 * away[1], 2.0 * away[2] };
      EXPECT_LT(Distance(GradientAt(potential, place.At(pixel)), place.Turn(by)), 1e-12) << "slope";
    };
    expect({ 8.0, 0.0, 12.0 }, 1.0, { 1.0, 0.0, 0.0 });
    expect({ 4.0, -7.0, 12.0 }, 1.0, { 0.0, -1.0, 0.0 });
    expect({ 4.0, 0.0, 26.0 }, 20.0, { 0.0, 0.0, 1.0 });
    expect({ 12.0, 18.0, 12.0 }, 5.0, { 0.6, 0.8, 0.0 });
    potential->InvertInsideOn();
    expect({ 12.0, 18.0, 12.0 }, 5.0, { 0.6, 0.8, 0.0 });
    EXPECT_EQ(ValueAt(potential, place.At({ 4.0, 0.0, 12.0 })), 7.0) << "inverted in the box";
    EXPECT_TRUE(ValueAt(potential, { 1e300, -1e300, 1e300 }) > 1e100) << "very far away";
    double bounds[6], expected[6];
    potential->GetInput()->GetBounds(expected);
    EXPECT_TRUE(potential->GetGridBounds(bounds)) << "there are bounds";
    for (int i = 0; i < 6; ++i)
    {
      EXPECT_NEAR(bounds[i], expected[i], 1e-12) << "bound " << i;
    }
  }
}

TEST(TestGridPotential, IsoValueAndInvertInsideSaySide)
{
  const Place place(false);
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(MakeImage(place, VTK_SHORT, Linear));
  const Point x = place.At({ 4.0, 0.0, 12.0 }); // 28
  EXPECT_EQ(ValueAt(potential, x), 28.0) << "at the defaults";
  potential->SetIsoValue(30.0);
  EXPECT_EQ(ValueAt(potential, x), -2.0) << "below IsoValue is inside";
  potential->InvertInsideOn();
  EXPECT_EQ(ValueAt(potential, x), 2.0) << "InvertInside: below is outside";
}

TEST(TestGridPotential, NaNPixelsSpoilTheVoxelsThatTouchThem)
{
  const Place place(true);
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(MakeImage(place, VTK_FLOAT,
    [](double i, double j, double k) { return i == 4 && j == 0 && k == 12 ? NaN : 1.0; }));
  for (const double i : { 3.5, 4.5 })
  {
    for (const double j : { -0.5, 0.5 })
    {
      const Point x = place.At({ i, j, 12.5 });
      EXPECT_TRUE(std::isnan(ValueAt(potential, x))) << "beside the pixel";
      EXPECT_TRUE(std::isnan(GradientAt(potential, x)[1])) << "gradient beside the pixel";
    }
  }
  EXPECT_EQ(ValueAt(potential, place.At({ 5.5, 0.5, 12.5 })), 1.0) << "two voxels away";
  EXPECT_TRUE(std::isnan(ValueAt(potential, { NaN, 0.0, 0.0 }))) << "a place that is NaN";
  EXPECT_TRUE(std::isnan(ValueAt(potential, { 0.0, Infinity, 0.0 }))) << "a place at infinity";
}

// F is a cubic along any line through a voxel, with a third derivative of at most 192. Central
// differences are off by step^2 / 6 times that, 3e-9.
TEST(TestGridPotential, GradientIsThatOfTheValue)
{
  const double step = 1e-5;
  for (const bool isTurned : { false, true })
  {
    const Place place(isTurned);
    vtkNew<vtkGridPotential> potential;
    potential->SetInput(MakeNoise(place, 2));
    Random random(3);
    for (int n = 0; n < 500; ++n)
    {
      Point pixel = PixelIn(place, random);
      for (double& c : pixel)
      {
        c = std::floor(c) + random.Between(0.001, 0.999); // 1e-5 is 4e-5 pixels
      }
      const Point x = place.At(pixel);
      const Point gradient = GradientAt(potential, x);
      for (int axis = 0; axis < 3; ++axis)
      {
        Point before = x, after = x;
        before[axis] -= step;
        after[axis] += step;
        const double rise = ValueAt(potential, after) - ValueAt(potential, before);
        EXPECT_NEAR(gradient[axis], rise / (after[axis] - before[axis]), 1e-8) << "gradient";
      }
    }
  }
}

TEST(TestGridPotential, MirroredAxesAreNoError)
{
  Place place(false);
  place.Spacing = { -0.5, 0.25, 2.0 };
  place.Direction = { 1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0 };
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(MakeImage(place, VTK_DOUBLE, Linear));
  Random random(4);
  for (int n = 0; n < 100; ++n)
  {
    const Point pixel = PixelIn(place, random);
    const double value = Linear(pixel[0], pixel[1], pixel[2]);
    EXPECT_NEAR(ValueAt(potential, place.At(pixel)), value, 1e-12) << "value";
  }
}

TEST(TestGridPotential, WaysOfAskingGiveTheSameBytes)
{
  const Place place(true);
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(MakeNoise(place, 5));
  Random random(6);
  std::vector<Point> points;
  for (int n = 0; n < 5000; ++n)
  {
    const Point pixel = PixelIn(place, random);
    points.push_back(place.At({ 1.5 * pixel[0] - 2.0, pixel[1], pixel[2] })); // some outside
  }
  const std::vector<double> one = SampleAll(potential, points);
  std::vector<double> values(points.size()), gradients(3 * points.size()), batch;
  potential->EvaluateBatch(5000, points[0].data(), values.data(), gradients.data());
  vtkNew<vtkDoubleArray> in, out;
  in->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    in->InsertNextTuple(points[i].data());
    batch.push_back(values[i]);
    batch.insert(batch.end(), &gradients[3 * i], &gradients[3 * i] + 3);
  }
  potential->EvaluateFunction(in, out);
  EXPECT_TRUE(AreSameBytes(one, batch)) << "EvaluateBatch";
  EXPECT_TRUE(AreSameBytes(values, { out->GetPointer(0), out->GetPointer(0) + 5000 })) << "arrays";
  vtkNew<vtkGridPotential> fresh;
  fresh->SetInput(potential->GetInput());
  for (const std::vector<double>& byThread : SampleByThreads(fresh, points))
  {
    EXPECT_TRUE(AreSameBytes(one, byThread)) << "several threads";
  }
}

namespace
{
class Slope : public activesurface::GridSamples
{
public:
  double Evaluate(const double x[3], double* gradient) const override
  {
    if (gradient)
    {
      gradient[0] = 2.0;
      gradient[1] = gradient[2] = 0.0;
    }
    return 2.0 * x[0];
  }
  bool GetBounds(double bounds[6]) const override
  {
    std::fill_n(bounds, 6, 4.0);
    return true;
  }
};
}

TEST(TestGridPotential, SamplesTakeThePlaceOfAnInput)
{
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(MakeSmallImage(4, 4, 4));
  EXPECT_EQ(ValueAt(potential, { 1.0, 1.0, 1.0 }), -1.0) << "the image";
  potential->SetSamples(std::make_shared<Slope>());
  potential->SetIsoValue(5.0);
  EXPECT_TRUE(potential->GetInput() == nullptr) << "the input is let go";
  EXPECT_EQ(ValueAt(potential, { 3.0, 1.0, 1.0 }), 6.0) << "value";
  EXPECT_TRUE((GradientAt(potential, { 3.0, 1.0, 1.0 }) == Point{ 2.0, 0.0, 0.0 })) << "gradient";
  double bounds[6];
  EXPECT_TRUE(potential->GetGridBounds(bounds) && bounds[5] == 4.0) << "bounds";
  vtkNew<vtkTransform> transform;
  transform->Translate(-1.0, 0.0, 0.0);
  potential->SetTransform(transform);
  EXPECT_EQ(potential->FunctionValue(0.0, 0.0, 0.0), -2.0) << "under a transform";
  potential->SetSamples(nullptr);
  EXPECT_EQ(ValueAt(potential, { 3.0, 1.0, 1.0 }), 1.0) << "no samples";
}

}
