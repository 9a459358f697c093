"""Ray as an engine: `--cluster ray://auto`, `ray://host:6379`, or `ray://local` to start one."""

from concurrent.futures import Executor

import ray


class RayExecutor(Executor):
    def __init__(self, address):
        ray.init(address, log_to_driver=False, include_dashboard=False)
        self.workers = int(ray.cluster_resources()["CPU"])
        self.remote = {}

    def submit(self, fn, /, *args, **named):
        if fn not in self.remote:
            self.remote[fn] = ray.remote(fn)
        return self.remote[fn].remote(*args, **named).future()

    def shutdown(self, wait=True, *, cancel_futures=False):
        ray.shutdown()
