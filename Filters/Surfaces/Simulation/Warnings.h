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
  void SetListener(const Listener& listener) { this->Tell = listener; }

  void Say(const std::string& reason, const std::string& sentence, Kind kind = Kind::Warning) const
  {
    if (this->Told.insert(reason).second && this->Tell)
    {
      this->Tell(kind, sentence);
    }
  }

  // Allows all reasons to be reported again.
  void Forget() { this->Told.clear(); }

private:
  Listener Tell;
  mutable std::set<std::string> Told;
};

}

#endif
