// Warnings and notes for users, each reason reported once.

#ifndef Warnings_h
#define Warnings_h

#include <functional>
#include <set>
#include <string>

namespace activesurface
{

class Warnings
{
public:
  enum class Kind
  {
    Note, // a choice of the filter, not a problem
    Warning
  };
  using Listener = std::function<void(Kind kind, const std::string& sentence)>;
  void SetListener(const Listener& listener) { this->Report = listener; }

  void Say(const std::string& reason, const std::string& sentence, Kind kind = Kind::Warning) const
  {
    if (this->Reported.insert(reason).second && this->Report)
    {
      this->Report(kind, sentence);
    }
  }

  // Allows all reasons to be reported again.
  void Forget() { this->Reported.clear(); }

private:
  Listener Report;
  mutable std::set<std::string> Reported;
};

}

#endif
