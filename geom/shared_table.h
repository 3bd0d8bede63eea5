#pragma once
// A table that nobody changes any more: copies share it.

#include <memory>
#include <utility>

#include "geom/ids.h"

namespace geom {

/// Like a constant Table, but a copy costs a count. Reading does not go by the count's way.
template <class I, class T>
class SharedTable {
 public:
  SharedTable() = default;
  explicit SharedTable(Table<I, T> values)
      : table_(std::make_shared<const Table<I, T>>(std::move(values))), first_(table_->data()) {}

  std::size_t size() const { return table_ ? table_->size() : 0; }
  bool empty() const { return size() == 0; }
  const T& operator[](I i) const { return first_[i.index()]; }
  const Table<I, T>& table() const { return table_ ? *table_ : none; }

 private:
  inline static const Table<I, T> none{};
  std::shared_ptr<const Table<I, T>> table_;
  const T* first_ = nullptr;
};

}  // namespace geom
