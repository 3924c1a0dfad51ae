"""What is spoilt, and the test that must notice it. A mutation: a name, a source, its edits (a text that stands there
once, and what it becomes), and the test."""

RECORD_LOG = "engine/io/record_log.cpp"
RECORDS = "engine/io/records.cpp"
POSIX = "engine/io/posix_env.cpp"
FOLDERS = "engine/io/folders.cpp"
ATOMIC = "engine/io/atomic_file.cpp"

A_PREFIX = "CrashOfALog.LeavesAPrefixWithAllThatWasSavedWheneverPowerIsLost"
EARLIER = "CrashOfALog.NeverLosesTheOperationBefore"
RESTART = "RestartOfALog.LosesNothingThatWasReadWhenPowerIsLostAfterAKill"
TORN = "RestartOfALog.KeepsATornEndWheneverPowerIsLost"
NO_RETRY = "RecordLog.TriesASyncThatFailedNeverAgain"
ATOMIC_ORDER = "AtomicFile.IsDurableInTheOrderThatACrashNeeds"

RENAME_NEW = """  if (const Status named = env.rename(unnamed(path), path); !named) {
    return named.error();
  }
"""
SYNC_CREATED = """  if (const Status durable = env.sync_folder(folder_of(path)); !durable) {
    return durable.error();
  }
"""
SYNC_REOPENED = """  if (const Status durable = (*file)->sync(); !durable) {
    return durable.error();
  }
"""
NAME_REOPENED = """  if (const Status named = env.sync_folder(folder_of(path)); !named) {
    return named.error();
  }
  std::unique_ptr<RecordLog> log("""
NAME_DROPPED = """  if (Status named = env.sync_folder(folder_of(path)); !named) {
    return named;
  }
"""
SYNC_ATOMIC = """  if (Status durable = made_durable(temporary_path_, final_path_); !durable) {
    return durable;
  }
"""
CUT = "  return env.truncate(path, whole);\n"
OPEN_BESIDE = "  auto beside = env.open_append(path + \".dropped\");\n"

MUTATIONS = [
    ("no sync of a record", RECORD_LOG,
     [("if (const Status durable = written(*file_, bytes)", "if (const Status durable = file_->append(bytes)")],
     A_PREFIX),
    ("no sync of the folder of a new log", RECORD_LOG, [(RENAME_NEW + SYNC_CREATED, RENAME_NEW)], A_PREFIX),
    ("a new log has its name before it is synced", RECORD_LOG,
     [("if (const Status durable = written(**file, bytes)", "if (const Status durable = (*file)->append(bytes)"),
      (RENAME_NEW, RENAME_NEW + SYNC_REOPENED)], A_PREFIX),
    ("no sync of the folder after an earlier log was moved aside", RECORD_LOG,
     [("const Status durable = env.sync_folder(folder_of(path));\n    return", "const Status durable;\n    return")],
     EARLIER),
    ("no sync of a log that is gone on with", RECORD_LOG, [(SYNC_REOPENED, "")], RESTART),
    ("no sync of the folder of a log that is gone on with", RECORD_LOG,
     [(NAME_REOPENED, "  std::unique_ptr<RecordLog> log(")], RESTART),
    ("no sync of a torn end that is kept beside", RECORD_LOG,
     [("Status kept = written(**beside, dropped)", "Status kept = (*beside)->append(dropped)")], TORN),
    ("no sync of the folder of a torn end", RECORD_LOG, [(NAME_DROPPED, "")], TORN),
    ("a torn end is cut off before it is kept", RECORD_LOG,
     [(OPEN_BESIDE, "  Status cut = env.truncate(path, whole);\n" + OPEN_BESIDE), (CUT, "  return cut;\n")], TORN),
    ("a sync that failed is tried again", RECORD_LOG,
     [("  return appended ? file.sync() : appended;\n",
       "  if (appended && file.sync()) {\n    return {};\n  }\n  return appended ? file.sync() : appended;\n")],
     NO_RETRY),
    ("a log goes on after a failure", RECORD_LOG, [("    failure_ = durable.error();\n", "")], NO_RETRY),
    ("the CRC of a record is not looked at", RECORDS,
     [("if (check_of(length, head.substr(0, checked), check) != stated) {", "if (stated == 0 && checked == 0) {")],
     "Records.NoticeEveryChangedByte"),
    ("the CRC of a record knows nothing of those before it", RECORDS,
     [("put(chained, before);", "put(chained, before * 0);")], "Records.AreWholeOnlyAfterThoseBeforeThem"),
    ("PosixFile syncs nothing", POSIX, [("::fsync(file_.get()) == 0 ? ", "file_.get() >= 0 ? ")],
     "PosixLog.SyncsEveryRecord"),
    ("PosixFile tells of no sync that failed", POSIX,
     [("::fsync(file_.get()) == 0 ? ", "::fsync(file_.get()) <= 0 ? ")], "PosixLog.WritesNothingAfterASyncThatFailed"),
    ("no folder is synced", FOLDERS, [("sync_path(folder, O_DIRECTORY);", "{true, 0};")],
     "PosixLog.IsOnTheDiskBeforeItHasItsName"),
    ("new folders are not synced into those above", FOLDERS,
     [("durable = sync_folder(folder_of(folder->string()));", "durable = {};")],
     "Folders.AreDurableInEachParentThatGotANewOne"),
    ("no sync of a file that appears as a whole", ATOMIC, [(SYNC_ATOMIC, "")], ATOMIC_ORDER),
    ("a file has its name before it is synced", ATOMIC,
     [(SYNC_ATOMIC, ""), ("  return sync_folder(folder_of(final_path_));\n",
                          "  const Status late = made_durable(final_path_, final_path_);\n"
                          "  return late ? sync_folder(folder_of(final_path_)) : late;\n")], ATOMIC_ORDER),
    ("no sync of the folder of a file that appears", ATOMIC,
     [("  return sync_folder(folder_of(final_path_));\n", "  return {};\n")], ATOMIC_ORDER),
]
