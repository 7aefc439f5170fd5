// Evaluates a potential at all points of an array, in parallel and in batches.

#ifndef BatchEvaluation_h
#define BatchEvaluation_h

#include "vtkDataArray.h"
#include "vtkSMPTools.h"

#include <algorithm>

namespace activesurface
{

constexpr vtkIdType PointsAtOnce = 256;
constexpr vtkIdType PointsPerTask = 2048;

// Evaluates the potential at the points of `input`, in parallel, and resizes the output. The
// potential's EvaluateBatch has to be thread-safe. input: points of three components.
template <class Potential>
void EvaluateArray(const Potential& potential, vtkDataArray* input, vtkDataArray* output)
{
  output->SetNumberOfComponents(1);
  output->SetNumberOfTuples(input->GetNumberOfTuples());
  vtkSMPTools::For(0, input->GetNumberOfTuples(), PointsPerTask,
    [&potential, input, output](vtkIdType begin, vtkIdType end)
    {
      double points[3 * PointsAtOnce];
      double values[PointsAtOnce];
      for (; begin < end; begin += PointsAtOnce)
      {
        const vtkIdType count = std::min(PointsAtOnce, end - begin);
        for (vtkIdType i = 0; i < 3 * count; ++i)
        {
          // GetTuple is not thread-safe for all kinds of arrays.
          points[i] = input->GetComponent(begin + i / 3, static_cast<int>(i % 3));
        }
        potential.EvaluateBatch(count, points, values, nullptr);
        for (vtkIdType i = 0; i < count; ++i)
        {
          output->SetComponent(begin + i, 0, values[i]);
        }
      }
    });
}

}

#endif
