// Digests of files against the examples of the standard.
#include "solver/base/digest.h"

#include <gtest/gtest.h>

#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

TEST(Sha256, IsWhatTheStandardSays) {
  // FIPS 180-4, examples of NIST: "abc", a message of two blocks, and nothing.
  test::Folder folder;
  folder.write("abc", "abc");
  folder.write("two", "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq");
  folder.write("none", "");
  EXPECT_EQ(sha256_of_file(folder / "abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_file(folder / "two"), "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_of_file(folder / "none"), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256, OfManyParts) {
  // A million times "a" (the same source): more than is read at once.
  test::Folder folder;
  folder.write("million", std::string(1000000, 'a'));
  EXPECT_EQ(sha256_of_file(folder / "million"), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, OfNoFileIsAnError) {
  EXPECT_THROW(sha256_of_file("/nowhere/at/all"), RunError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
