/**
 * A disk that is full after so many bytes, as far as this process sees it.
 */
#ifndef SmallDisk_h
#define SmallDisk_h

#include <csignal>

#include <sys/resource.h>

namespace activesurface
{

/** Files are limited to that size while it lives. */
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
