/**
 * The messages of a VTK object, kept off the console so that a test can check them.
 */
#ifndef MessageCapture_h
#define MessageCapture_h

#include "vtkObject.h"
#include "vtkWeakPointer.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace activesurface
{

/** Captures from its construction until its destruction. */
class MessageCapture
{
public:
  explicit MessageCapture(vtkObject* object);
  ~MessageCapture();
  MessageCapture(const MessageCapture&) = delete;
  void operator=(const MessageCapture&) = delete;

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
  /** Of the executive, if the object is an algorithm: that a request has failed. */
  std::vector<std::string> PipelineErrors;

  /** Of all three kinds. */
  std::size_t CountAll() const;

  /** Whether an error or a warning of the object contains the words. */
  bool Has(const std::string& words) const;

  /** The last error of the object; none: empty. */
  std::string GetLastError() const;

  /** How many of the messages contain the words; prints all if it is not just one. */
  static int Count(const std::vector<std::string>& messages, const std::string& words);

private:
  void Observe(vtkObject* object, unsigned long event, std::vector<std::string>& messages);

  std::vector<std::pair<vtkWeakPointer<vtkObject>, unsigned long>> Observers;
};

}

#endif
