#pragma once

namespace oversketch::testing {

/// From now on the `nth` call (from 1) that writes to a disk fails with that error: creating, linking, renaming or
/// removing a file, making a folder, writing, cutting and syncing.  A write that is to fail for want of room puts half
/// of it down before.  nth = 0: none fails, calls are counted.
void fail_disk_call(int nth, int error);
/// All is well again; returns how many calls there were.
int mend_disk();

} // namespace oversketch::testing
