/**
 * Simulates a full disk by a limit on the size of the files of this process.
 */
#ifndef SmallDisk_h
#define SmallDisk_h

#include <csignal>

#include <sys/resource.h>

namespace activesurface
{

/** Limits files to `size` bytes during its lifetime. */
class SmallDisk
{
public:
  explicit SmallDisk(rlim_t size)
  {
    getrlimit(RLIMIT_FSIZE, &this->Before);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = { size, this->Before.rlim_max };
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() { setrlimit(RLIMIT_FSIZE, &this->Before); }
  SmallDisk(const SmallDisk&) = delete;
  void operator=(const SmallDisk&) = delete;

private:
  rlimit Before;
};

}

#endif
