/* The clock of a computer that is wrong by CLOCK_OFFSET_MS: preloaded before the libraries. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <time.h>

int clock_gettime(clockid_t id, struct timespec *now) {
  static int (*real)(clockid_t, struct timespec *);
  static long offset;
  if (!real) {
    const char *text = getenv("CLOCK_OFFSET_MS");
    offset = text ? atol(text) : 0;
    real = (int (*)(clockid_t, struct timespec *))dlsym(RTLD_NEXT, "clock_gettime");
  }
  int failed = real(id, now);
  if (!failed && id == CLOCK_REALTIME) {
    long long all = now->tv_sec * 1000000000LL + now->tv_nsec + offset * 1000000LL;
    now->tv_sec = all / 1000000000LL;
    now->tv_nsec = all % 1000000000LL;
  }
  return failed;
}
