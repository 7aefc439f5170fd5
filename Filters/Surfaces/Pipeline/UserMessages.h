// Warnings and errors of the filter, which VTK shows. Within ParaView fewer messages are shown.
//
// ParaView opens a window for each warning and each error. ParaView requests each output port
// separately, and again for each view. Each executive adds an error to a failed request. Within
// ParaView, therefore:
// - The same warning is shown once, and a note does not open the window.
// - An error equal to the last one is shown only after a change of the filter or a success.
// - A failed request returns success, with empty outputs.

#ifndef UserMessages_h
#define UserMessages_h

#include "Targets/Warnings.h"

#include "vtkType.h"

#include <set>
#include <string>

class vtkAlgorithm;

namespace activesurface
{

class UserMessages
{
public:
  explicit UserMessages(vtkAlgorithm* filter)
    : Filter(filter)
  {
  }

  void Warn(Warnings::Kind kind, const std::string& sentence);

  // Shows an error. Returns the value for RequestData to return once the outputs are empty.
  int Fail(const std::string& sentence);

  // Call this after a request without an error.
  void ForgetError() { this->LastError.clear(); }

private:
  bool IsInParaView() const;

  vtkAlgorithm* Filter;
  std::set<std::string> Shown; // within ParaView
  std::string LastError;
  vtkMTimeType LastErrorMTime = 0;
};

}

#endif
