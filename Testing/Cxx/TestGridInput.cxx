// What vtkGridPotential takes for an image, what it refuses, and when it looks again.

#include "Check.h"
#include "GridShapes.h"

#include "vtkFloatArray.h"
#include "vtkUnstructuredGrid.h"

#include <functional>

namespace
{
void ExpectError(Check& check, vtkGridPotential* potential, const std::string& words)
{
  const Listener listener(potential);
  check.Equal(ValueAt(potential, { 1.5, 1.5, 1.5 }), 1.0, words + ": outside everywhere");
  check.True(GradientAt(potential, { 1.5, 1.5, 1.5 }) == Point{ 0.0, 0.0, 0.0 }, "no gradient");
  check.Equal(listener.Errors, 1, words + ": one error");
  check.True(listener.Said(words), words + ": is what it says");
  const std::string told = potential->GetError();
  check.True(told.find(words) != std::string::npos && told.back() == '.', told + ": GetError");
  double bounds[6];
  check.True(!potential->GetGridBounds(bounds) && bounds[0] > bounds[1], words + ": no bounds");
}

}

void InputOfNoUseIsOneError(Check& check)
{
  const auto expect = [&check](vtkDataSet* input, const std::string& words, const char* name = "")
  {
    vtkNew<vtkGridPotential> potential;
    potential->SetInput(input);
    potential->SetScalarArrayName(name);
    ExpectError(check, potential, words);
  };
  expect(vtkNew<vtkUnstructuredGrid>(), "A vtkUnstructuredGrid");
  expect(vtkNew<vtkImageData>(), "is empty");
  expect(MakeSmallImage(4, 1, 4), "is flat");
  expect(MakeSmallImage(4, 4, 4, 3), "have 3 components");
  expect(MakeSmallImage(4, 4, 4), "\"absent\" is missing", "absent");
  auto image = MakeSmallImage(4, 4, 4);
  image->GetPointData()->GetScalars()->Resize(10);
  expect(image, "have 10 values for 64 pixels");
  image = MakeSmallImage(4, 4, 4);
  image->GetPointData()->Initialize();
  expect(image, "no numeric point array");
  const auto expectNoPlace = [&expect](const std::function<void(vtkImageData*)>& spoil)
  {
    auto spoilt = MakeSmallImage(4, 4, 4);
    spoil(spoilt);
    expect(spoilt, "no place in space");
  };
  expectNoPlace([](vtkImageData* i) { i->SetSpacing(1.0, 0.0, 1.0); });
  expectNoPlace([](vtkImageData* i) { i->SetSpacing(1.0, 1.0, NaN); });
  expectNoPlace([](vtkImageData* i) { i->SetOrigin(NaN, 0.0, 0.0); });
  expectNoPlace([](vtkImageData* i) { i->SetDirectionMatrix(1, 1, 0, 0, 1, 0, 0, 0, 1); });
}

void ErrorsCanBeKeptQuiet(Check& check)
{
  vtkNew<vtkGridPotential> potential;
  const Listener listener(potential);
  check.Equal(ValueAt(potential, { 0.0, 0.0, 0.0 }), 1.0, "no input");
  check.Equal(std::string(potential->GetError()), "There is no input.", "GetError");
  potential->SetReportErrors(false);
  potential->SetInput(MakeSmallImage(4, 4, 1));
  check.Equal(ValueAt(potential, { 0.0, 0.0, 0.0 }), 1.0, "flat");
  check.True(std::string(potential->GetError()).find("flat") != std::string::npos, "GetError");
  check.Equal(listener.Errors, 0, "errors");
  potential->SetInput(MakeSmallImage(4, 4, 4));
  check.Equal(ValueAt(potential, { 1.0, 1.0, 1.0 }), -1.0, "an image of use");
  check.Equal(std::string(potential->GetError()), "", "GetError");
}

void ChangesOfTheImageAreSeen(Check& check)
{
  auto image = MakeSmallImage(4, 4, 4);
  vtkNew<vtkFloatArray> other;
  other->SetName("other");
  other->SetNumberOfTuples(64);
  other->Fill(3.0);
  image->GetPointData()->AddArray(other);
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(image);
  const auto isSeen = [&](double expected, const char* sentence)
  {
    static vtkMTimeType before = 0;
    check.True(potential->GetMTime() > before, std::string("GetMTime: ") + sentence);
    check.Equal(ValueAt(potential, { 2.5, 1.0, 1.0 }), expected, sentence);
    before = potential->GetMTime();
  };
  isSeen(-1.0, "at the start");
  image->GetPointData()->GetScalars()->Fill(-2.0);
  image->GetPointData()->GetScalars()->Modified();
  isSeen(-2.0, "pixels");
  image->SetSpacing(0.5, 1.0, 1.0);
  isSeen(1.0, "spacing: now outside");
  image->SetOrigin(2.0, 0.0, 0.0);
  isSeen(-2.0, "origin");
  potential->SetScalarArrayName("other");
  isSeen(3.0, "ScalarArrayName");
  potential->SetIsoValue(1.0);
  isSeen(2.0, "IsoValue");
  potential->InvertInsideOn();
  isSeen(-2.0, "InvertInside");
  potential->SetInput(nullptr);
  isSeen(1.0, "no input");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    {
      { "InputOfNoUseIsOneError", InputOfNoUseIsOneError },
      { "ErrorsCanBeKeptQuiet", ErrorsCanBeKeptQuiet },
      { "ChangesOfTheImageAreSeen", ChangesOfTheImageAreSeen },
    });
}
