// What a user should know, told once for each reason.

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
  using Listener = std::function<void(const std::string& sentence)>;
  void SetListener(const Listener& listener) { this->Tell = listener; }

  void Say(const std::string& reason, const std::string& sentence) const
  {
    if (this->Told.insert(reason).second && this->Tell)
    {
      this->Tell(sentence);
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
