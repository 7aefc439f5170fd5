// Series of files, one for each time step: names and times.

#ifndef FileSeries_h
#define FileSeries_h

#include <string>
#include <vector>

class vtkDataObject;
class vtkInformation;

namespace activesurface
{

// Inserts the number into the pattern. The number replaces the last run of # in the file's name,
// padded by zeros to the length of the run, at most 32. Without #, the number replaces %d or %0Nd.
// Without any placeholder, inserts at least four digits before the extension if `always` is true.
std::string MakeFrameName(const std::string& pattern, int number, bool always);

// Times of the files of a series; NaN: unavailable. If a time is not finite, or the times do not
// ascend strictly, the file indices replace all times.
class FileTimes
{
public:
  FileTimes() = default;
  explicit FileTimes(std::vector<double> stated);

  // Returns the index of the file for the requested time of an output; 0 without a request.
  int FindFile(vtkInformation* output) const;
  // Sets the time steps of an output if there are several files, else removes them.
  void Publish(vtkInformation* output) const;
  // Sets the time of a file's data, if there are several files.
  void Mark(int file, vtkDataObject* data) const;

private:
  std::vector<double> Times;
};

}

#endif
