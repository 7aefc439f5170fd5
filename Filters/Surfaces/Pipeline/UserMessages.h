// Warnings and errors of the filter, as VTK shows them; fewer of them within ParaView.
//
// ParaView opens a window for each warning and each error. It asks for each output port by itself,
// again for each view, and lets each pipeline that gets nothing add what its request was. So within
// ParaView the same warning is shown once, a note without opening the window, and an error once for
// each change; the outputs are then empty.

#ifndef UserMessages_h
#define UserMessages_h

#include "Simulation/Warnings.h"

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

  // Shows an error. Returns what the request for data returns, after the outputs were emptied.
  int Fail(const std::string& sentence);

  // After a request without an error.
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
