"""Stores that were made so that reading them is much work: a few bytes that become many, rows without an end, numbers
and texts that no store of ours has. Each is a change of a finished store, by its connection."""
import contextlib
import os
import re
import sqlite3

from foreign_schemas import ENDLESS, statements, values_of, view

MEGABYTE = 1 << 20
LARGEST, SMALLEST = 2**63 - 1, -2**63


def tables(db):
    """Each table of ours with its columns: (name, type)."""
    names = [name for name, in db.execute("select name from sqlite_schema where type = 'table' and name not like 'sqlite%'")]
    return {name: [(row[1], row[2]) for row in db.execute(f'pragma table_info("{name}")')] for name in names}


@contextlib.contextmanager
def any_types(db):
    """Tables take values of all types meanwhile; the schema is ours again at the end."""
    strict = db.execute("select name, sql from sqlite_schema where type = 'table' and sql like '%STRICT%'").fetchall()
    loose = [(re.sub(r"NOT NULL|\bSTRICT\s*(,|$)", "", text), name) for text, name in ((b, a) for a, b in strict)]
    written(db, loose)
    yield
    written(db, [(text, name) for name, text in strict])


def written(db, texts):
    db.execute("pragma writable_schema = on")
    db.executemany("update sqlite_schema set sql = ? where name = ?", texts)
    db.execute("pragma writable_schema = reset")


def columns_set(value, kinds=("INTEGER", "REAL", "TEXT"), keep=("meta",)):
    """All columns of these types become this value, where no key forbids it."""
    def change(db):
        db.execute("pragma ignore_check_constraints = on")
        with any_types(db):
            for table, columns in tables(db).items():
                for column, kind in columns:
                    if table not in keep and kind in kinds:
                        with contextlib.suppress(sqlite3.Error):
                            db.execute(f'update or ignore "{table}" set "{column}" = ?', (value,))
    return change


def text_in(table, column, text, where="true"):
    def change(db):
        db.execute(f"update {table} set {column} = ? where {where}", (text() if callable(text) else text,))
    return change


def expanding(candidates, phrase, times, column="code"):
    """Codes that name one long phrase so often, in so many candidates."""
    def change(db):
        db.execute("insert into phrase (id, machine, parameters, modules) values (90000, ?, ?, ?)",
                   ("--nstates 1 --s0 0 --rwm0 " + "1" * phrase, '"a":"' + "x" * phrase + '"', '"stop":' + "1" * phrase))
        code = "{" + ",".join(['"90000":""'] * times) + "}" if column == "code" else "[" + ",".join(["90000"] * times) + "]"
        text = "machine = '', parameters = ''" if column == "code" else "modules = ''"
        db.execute(f"update candidate set {column} = ?, {text} where id in (select id from candidate limit ?)", (code, candidates))
    return change


def expanding_beside_others(db):
    """Each below any limit of one, all of them together not."""
    expanding(10**9, 50_000, 100)(db)


def deep(opening, closing, levels):
    return lambda: opening * levels + closing * levels


def multiplied(db, name, columns):
    """Rows of all tables by all others."""
    first = ", ".join(["a.candidate"] + ["b.pair"] * columns.count(","))
    return f"select {first} from evaluation a, evaluation b, evaluation c, evaluation d order by random()"


def nested_views(db):
    db.execute("create view n0 as select 1 as i")
    for n in range(200):
        db.execute(f"create view n{n + 1} as select a.i + b.i as i from n{n} a, n{n} b")
    view("v_designs", values_of("(select i from n30)"))(db)


def many_objects(db):
    db.execute("begin")
    for n in range(5000):
        db.execute(f"create table t{n} (a, b, c)")
    db.execute("commit")


def many_columns(db):
    db.execute(f"create table wide ({', '.join(f'c{n}' for n in range(1900))})")
    db.execute("insert into wide default values")


def many_designs(db):
    names = ", ".join(name for name, _ in tables(db)["design"] if name != "id")
    db.execute("with recursive n(i) as (select 2 union all select i + 1 from n limit 210)"
               f" insert into design (id, {names}) select i, {names} from n, design where design.id = 1")


def cycle_of_parents(db):
    db.execute("update candidate set parent = id")
    db.execute("update candidate set parent = id - 1 where id % 2 = 0")
    db.execute("update candidate set parent = id + 1 where id % 2 = 1 and id + 1 in (select id from candidate)")


def negative_ids(db):
    for table, columns in tables(db).items():
        for column, kind in columns:
            if kind == "INTEGER" and column in ("id", "candidate", "design", "number", "pair", "worker", "step", "best", "parent"):
                with contextlib.suppress(sqlite3.Error):
                    db.execute(f'update or ignore "{table}" set "{column}" = -"{column}"')


def real_runs_of(number):
    """A run that says it has so many cycles, and has none."""
    def change(db):
        columns = [name for name, _ in tables(db)["real_run"]]
        kinds = dict(tables(db)["real_run"])
        values = [number if kinds[name] == "INTEGER" else 1e300 if kinds[name] == "REAL" else "x" for name in columns]
        values[columns.index("id")], values[columns.index("candidate")] = 1, None
        db.execute(f"insert into real_run values ({','.join('?' * len(columns))})", values)
    return change


def page_size(size):
    return statements("pragma journal_mode = delete", f"pragma page_size = {size}", "vacuum", "pragma journal_mode = wal")


def in_encoding(name):
    """All rows in a file of this encoding; SQLite cannot change it, so it is written anew."""
    def change(db):
        path = db.execute("pragma database_list").fetchone()[2]
        texts = list(db.iterdump())
        version, program = (db.execute(f"pragma {what}").fetchone()[0] for what in ("user_version", "application_id"))
        db.close()
        os.unlink(path)
        with contextlib.closing(sqlite3.connect(path, isolation_level=None)) as new:
            new.execute(f"pragma encoding = '{name}'")
            new.execute("pragma page_size = 8192")
            new.execute("pragma foreign_keys = off")
            new.executescript("\n".join(texts))
            new.execute(f"pragma user_version = {version}")
            new.execute(f"pragma application_id = {program}")
    return change


def long_name(size):
    return lambda: "n" * size


CRAFTED = {
    "a code that expands to 2 GB": expanding(1, 4 * MEGABYTE, 500),
    "codes that expand to 7 GB together": expanding_beside_others,
    "codes of 30 MB each": expanding(10**9, 30_000, 1000),
    "module codes that expand": expanding(10**9, MEGABYTE, 300, "module_code"),
    "a phrase of 20 MB": expanding(2, 20 * MEGABYTE, 1),
    "a mission of 100,000 letters": text_in("design", "mission", long_name(100_000)),
    "a method of 100,000 letters": text_in("design", "method", long_name(100_000)),
    "a flavour of 100,000 letters": text_in("design", "flavour", long_name(100_000)),
    "a reason of 20 MB": text_in("design", "reason", long_name(20 * MEGABYTE)),
    "a campaign of 100,000 letters": text_in("campaign", "name", long_name(100_000)),
    "a source of 100,000 letters": text_in("source", "name", long_name(100_000)),
    "a file of 30 MB": text_in("campaign", "file", long_name(30 * MEGABYTE)),
    "deciding keys of 30 MB": text_in("campaign", "deciding", lambda: '{"a":"' + "x" * (30 * MEGABYTE) + '"}'),
    "a file of a million levels": text_in("campaign", "file", deep("a = [", "]", MEGABYTE)),
    "tables of a million levels": text_in("campaign", "file", lambda: "[" + "a." * MEGABYTE + "b]\n"),
    "deciding keys of a million levels": text_in("campaign", "deciding", deep('{"a":', "}", MEGABYTE)),
    "parameters of a million levels": text_in("candidate", "parameters", deep('{"a":', "}", 100_000), "id % 100 = 1"),
    "modules of a million levels": text_in("candidate", "modules", deep("[", "]", 100_000), "id % 100 = 1"),
    "machines of 300 kB": text_in("candidate", "machine", lambda: "--nstates 4 " + "--s0 1 " * 43_000, "id % 4 = 1"),
    "a machine of 20 MB": text_in("candidate", "machine", lambda: "--nstates 999999999 " + "--s0 1 " * 3 * MEGABYTE, "id = 8"),
    "events of 40 MB": statements("update event set text = '{\"a\":\"' || hex(zeroblob(500000)) || '\"}' where seq < 40"),
    "endless designs": view("v_designs", lambda db, name, columns: f"{ENDLESS} {', '.join(['i'] * (columns.count(',') + 1))} from n"),
    "endless candidates": view("v_candidates", lambda db, name, columns: f"{ENDLESS} {', '.join(['i'] * (columns.count(',') + 1))} from n"),
    "endless texts": view("candidate_text", lambda db, name, columns: f"{ENDLESS} {', '.join(['i'] * (columns.count(',') + 1))} from n"),
    "multiplied evaluations": view("v_evaluations", multiplied),
    "a view of a value of 900 MB": view("v_designs", values_of("zeroblob(900000000)", "1")),
    "a view of a text of 900 MB": view("v_campaigns", values_of("printf('%.*c', 900000000, 'x')", "1")),
    "views of views": nested_views,
    "5,000 tables": many_objects,
    "a table of 1,900 columns": many_columns,
    "designs of a large study": many_designs,
    "pages of 512 bytes": page_size(512),
    "pages of 65,536 bytes": page_size(65536),
    "UTF-16le": in_encoding("UTF-16le"),
    "UTF-16be": in_encoding("UTF-16be"),
    "texts for numbers": columns_set("nan", ("INTEGER", "REAL")),
    "blobs for texts": columns_set(b"\0\xff" * 1000, ("TEXT",)),
    "nothing for anything": columns_set(None),
    "largest numbers": columns_set(LARGEST, ("INTEGER",)),
    "smallest numbers": columns_set(SMALLEST, ("INTEGER",)),
    "endless scores": columns_set(float("inf"), ("REAL",)),
    "negative ids": negative_ids,
    "cycles of parents": cycle_of_parents,
    "a budget beyond all": text_in("design", "budget", LARGEST),
    "experiments beyond all": text_in("design", "used", LARGEST),
    "a repetition beyond all": text_in("design", "repetition", SMALLEST),
    "steps beyond all": text_in("race_step", "evaluated", LARGEST),
    "a best one that is none": text_in("design", "best", 999_999),
    "seeds beyond all": text_in("pair", "seed", LARGEST),
    "real runs beyond all": real_runs_of(LARGEST),
    "no campaign": statements("delete from campaign"),
    "no designs": statements("delete from design"),
    "no rows": lambda db: [db.execute(f'delete from "{name}"') for name in tables(db)],
}


def craft(store, change):
    """As a store of an earlier version, which says nothing about its rows: what is made is read, not refused for that."""
    with contextlib.closing(sqlite3.connect(store, isolation_level=None)) as db:
        db.execute("pragma foreign_keys = off")
        change(db)
    with contextlib.closing(sqlite3.connect(store, isolation_level=None)) as db:
        db.execute("delete from meta where key = 'row_sums'")
        db.execute("pragma wal_checkpoint(truncate)")
