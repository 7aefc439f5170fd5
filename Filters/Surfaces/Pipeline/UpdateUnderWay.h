// Records that an update is running. An update calls observers of its progress and messages; their
// calls must not remove the data in use.

#ifndef UpdateUnderWay_h
#define UpdateUnderWay_h

#include <stdexcept>
#include <string>

namespace activesurface
{

class UpdateUnderWay
{
public:
  class Scope
  {
  public:
    explicit Scope(UpdateUnderWay& update)
      : Update(update)
      , Before(update.Is) // an observer may request information
    {
      this->Update.Is = true;
    }
    Scope(const Scope&) = delete;
    void operator=(const Scope&) = delete;
    ~Scope() { this->Update.Is = this->Before; }

  private:
    UpdateUnderWay& Update;
    const bool Before;
  };

  // Throws std::logic_error if an observer makes this call during an update.
  void Refuse(const std::string& call) const
  {
    if (this->Is)
    {
      throw std::logic_error(call +
        " has been called in an update, by an observer of it; stop the update (AbortExecute) and "
        "call it afterwards.");
    }
  }

private:
  bool Is = false;
};

}

#endif
