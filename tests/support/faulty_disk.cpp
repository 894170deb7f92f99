#include "tests/support/faulty_disk.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <new>

namespace swarmsmith {
namespace {

/// What SQLite sees as a file; the real file's bytes lie right behind.
struct File {
  sqlite3_file base{};
  FaultyDisk* disk = nullptr;
  std::string* path = nullptr;

  sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

File& of(sqlite3_file* file) {
  return *reinterpret_cast<File*>(file);
}
FaultyDisk& disk_of(sqlite3_vfs* vfs) {
  return *static_cast<FaultyDisk*>(vfs->pAppData);
}

int close(sqlite3_file* file) {
  delete of(file).path;
  sqlite3_file* real = of(file).real();
  return real->pMethods == nullptr ? SQLITE_OK : real->pMethods->xClose(real);
}
int read(sqlite3_file* file, void* to, int size, sqlite3_int64 at) {
  return of(file).real()->pMethods->xRead(of(file).real(), to, size, at);
}
int write(sqlite3_file* file, const void* from, int size, sqlite3_int64 at) {
  if (const int code = of(file).disk->next_change(); code != SQLITE_OK) return code;
  of(file).disk->wrote(*of(file).path, at, static_cast<const char*>(from), size);
  return of(file).real()->pMethods->xWrite(of(file).real(), from, size, at);
}
int truncate(sqlite3_file* file, sqlite3_int64 size) {
  if (const int code = of(file).disk->next_change(); code != SQLITE_OK) return code;
  of(file).disk->truncated(*of(file).path, size);
  return of(file).real()->pMethods->xTruncate(of(file).real(), size);
}
int sync(sqlite3_file* file, int) {
  if (const int code = of(file).disk->next_change(); code != SQLITE_OK) return code;
  of(file).disk->synced(*of(file).path);
  return SQLITE_OK;  // the real one would only cost time: the crash is ours to make
}
int file_size(sqlite3_file* file, sqlite3_int64* size) {
  return of(file).real()->pMethods->xFileSize(of(file).real(), size);
}
int lock(sqlite3_file* file, int kind) {
  return of(file).real()->pMethods->xLock(of(file).real(), kind);
}
int unlock(sqlite3_file* file, int kind) {
  return of(file).real()->pMethods->xUnlock(of(file).real(), kind);
}
int check_reserved_lock(sqlite3_file* file, int* held) {
  return of(file).real()->pMethods->xCheckReservedLock(of(file).real(), held);
}
int file_control(sqlite3_file* file, int what, void* argument) {
  return of(file).real()->pMethods->xFileControl(of(file).real(), what, argument);
}
int sector_size(sqlite3_file* file) {
  return of(file).real()->pMethods->xSectorSize(of(file).real());
}
int device(sqlite3_file* file) {
  return of(file).real()->pMethods->xDeviceCharacteristics(of(file).real());
}
int shm_map(sqlite3_file* file, int page, int size, int extend, void volatile** to) {
  return of(file).real()->pMethods->xShmMap(of(file).real(), page, size, extend, to);
}
int shm_lock(sqlite3_file* file, int offset, int count, int flags) {
  return of(file).real()->pMethods->xShmLock(of(file).real(), offset, count, flags);
}
void shm_barrier(sqlite3_file* file) {
  of(file).real()->pMethods->xShmBarrier(of(file).real());
}
int shm_unmap(sqlite3_file* file, int remove) {
  return of(file).real()->pMethods->xShmUnmap(of(file).real(), remove);
}

constexpr sqlite3_io_methods kMethods{2,
                                      close,
                                      read,
                                      write,
                                      truncate,
                                      sync,
                                      file_size,
                                      lock,
                                      unlock,
                                      check_reserved_lock,
                                      file_control,
                                      sector_size,
                                      device,
                                      shm_map,
                                      shm_lock,
                                      shm_barrier,
                                      shm_unmap,
                                      nullptr,
                                      nullptr};

int open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  auto& opened = *new (file) File;
  opened.disk = &disk_of(vfs);
  opened.real()->pMethods = nullptr;
  sqlite3_vfs* real = opened.disk->real();
  const int code = real->xOpen(real, name, opened.real(), flags, out_flags);
  if (code != SQLITE_OK) return code;
  opened.path = new std::string(name == nullptr ? "" : name);
  opened.disk->opened(*opened.path);
  opened.base.pMethods = &kMethods;
  return SQLITE_OK;
}

int remove(sqlite3_vfs* vfs, const char* name, int sync_folder) {
  if (const int code = disk_of(vfs).next_change(); code != SQLITE_OK) return code;
  disk_of(vfs).deleted(name);
  sqlite3_vfs* real = disk_of(vfs).real();
  return real->xDelete(real, name, sync_folder);
}

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

FaultyDisk::FaultyDisk() : real_(sqlite3_vfs_find(nullptr)), shim_(*real_) {
  shim_.pNext = nullptr;
  shim_.zName = "faulty";
  shim_.szOsFile = static_cast<int>(sizeof(File)) + real_->szOsFile;
  shim_.pAppData = this;
  shim_.xOpen = open;
  shim_.xDelete = remove;
  sqlite3_vfs_register(&shim_, 1);
}

FaultyDisk::~FaultyDisk() {
  sqlite3_vfs_unregister(&shim_);
  sqlite3_vfs_register(real_, 1);
}

void FaultyDisk::fail_at(std::int64_t n, int code, std::int64_t times) {
  const std::lock_guard guard(mutex_);
  first_failure_ = changes_ + n;
  failures_ = times;
  code_ = code;
}

void FaultyDisk::cut_power_at(std::int64_t n) {
  fail_at(n, SQLITE_IOERR, std::numeric_limits<std::int64_t>::max() / 2);
  cut_ = true;
}

int FaultyDisk::next_change() {
  const std::lock_guard guard(mutex_);
  ++changes_;
  const bool fails =
      code_ != SQLITE_OK && changes_ >= first_failure_ && changes_ < first_failure_ + failures_;
  off_ = off_ || (fails && cut_);
  return fails ? code_ : SQLITE_OK;
}

void FaultyDisk::opened(const std::string& path) {
  const std::lock_guard guard(mutex_);
  if (!path.empty() && !images_.contains(path)) images_[path].synced = content_of(path);
}

void FaultyDisk::wrote(const std::string& path, std::int64_t offset, const char* bytes, int size) {
  const std::lock_guard guard(mutex_);
  images_[path].pending.push_back({offset, std::string(bytes, static_cast<std::size_t>(size))});
}

void FaultyDisk::truncated(const std::string& path, std::int64_t size) {
  const std::lock_guard guard(mutex_);
  images_[path].pending.push_back({size, {}, true});
}

void FaultyDisk::synced(const std::string& path) {
  const std::lock_guard guard(mutex_);
  Image& image = images_[path];
  for (const Change& change : image.pending)
    apply(image.synced, change);
  image.pending.clear();
}

void FaultyDisk::deleted(const std::string& path) {
  const std::lock_guard guard(mutex_);
  images_.erase(path);
}

void FaultyDisk::apply(std::string& content, const Change& change) {
  const auto at = static_cast<std::size_t>(change.offset);
  if (change.truncation) return content.resize(at);
  if (content.size() < at + change.bytes.size()) content.resize(at + change.bytes.size());
  content.replace(at, change.bytes.size(), change.bytes);
}

void FaultyDisk::restart(Rng& rng) {
  const std::lock_guard guard(mutex_);
  for (auto& [path, image] : images_) {
    if (path.empty()) continue;
    for (Change& change : image.pending) {
      if (rng.bernoulli(0.5)) continue;
      // Only some of the sectors may have arrived.
      if (!change.truncation && rng.bernoulli(0.3))
        change.bytes.resize(rng.below(17) * 512 % (change.bytes.size() + 1));
      apply(image.synced, change);
    }
    std::ofstream(path, std::ios::binary | std::ios::trunc) << image.synced;
    std::filesystem::remove(path + "-shm");
  }
  images_.clear();
  code_ = SQLITE_OK;
  cut_ = off_ = false;
}

}  // namespace swarmsmith
