// Warnings and notes for users, each reported once for each reason.

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
    Note, // what the filter chose; nothing is wrong
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

  // All may be told again.
  void Forget() { this->Told.clear(); }

private:
  Listener Tell;
  mutable std::set<std::string> Told;
};

}

#endif
