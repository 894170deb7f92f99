"""Schemas that are not ours, and look it more or less: what a store has besides, instead or in another way. Each has the
name of the object that shows which one it is."""
import contextlib
import re
import sqlite3

#: A row of it makes rows without an end.
ENDLESS = "with recursive n(i) as (select 1 union all select i + 1 from n) select"


def statements(*sql):
    """Each of them, in a store whose schema may be written."""
    def change(db):
        for each in sql:
            db.execute(each)
    return change


def view(name, text):
    """Another one in its place, with its columns."""
    def change(db):
        columns = ", ".join(f'"{row[1]}"' for row in db.execute(f"pragma table_info({name})"))
        db.execute(f"drop view {name}")
        db.execute(f"create view {name} ({columns}) as {text(db, name, columns)}")
    return change


def values_of(first, rest="null"):
    """One row of a view: its first column this, the others that."""
    return lambda db, name, columns: f"select {', '.join([first] + [rest] * columns.count(','))}"


def endless(db, name, columns):
    return f"{ENDLESS} {', '.join(['i'] * (columns.count(',') + 1))} from n"


def text_of(db, name):
    row = db.execute("select sql from sqlite_schema where name = ?", (name,)).fetchone()
    if row is None:
        raise sqlite3.OperationalError(f"no such table: {name}")  # a store that was stopped while it was made
    return row[0]


def made_anew(table, old, new):
    """The table with another definition, and its rows."""
    def change(db):
        text = text_of(db, table)
        changed, times = re.subn(old, new, text, count=1)
        assert times == 1, (table, old, text)
        indexes = [sql for sql, in db.execute(
            "select sql from sqlite_schema where type = 'index' and tbl_name = ? and sql is not null", (table,))]
        columns = ", ".join(f'"{row[1]}"' for row in db.execute(f"pragma table_info({table})"))
        db.execute("pragma legacy_alter_table = on")
        db.execute(f"alter table {table} rename to moved")
        db.execute(changed)
        db.execute(f"insert into {table} ({columns}) select {columns} from moved")
        db.execute("drop table moved")
        for sql in indexes:
            db.execute(sql)
    return change


def text_replaced(name, old, new):
    """In the schema itself: rows stay as they are."""
    def change(db):
        changed, times = re.subn(old, new, text_of(db, name), count=1)
        assert times == 1, (name, old)
        db.execute("pragma writable_schema = on")
        db.execute("update sqlite_schema set sql = ? where name = ?", (changed, name))
        db.execute("pragma writable_schema = reset")
    return change


def trigger(when, of, do):
    return statements(f"create trigger t_mine {when} {of} begin {do}; end")


#: What it is: the object that a refusal names, and how it is made.
FOREIGN = {
    "trigger before insert": ("t_mine", trigger(
        "before insert on", "evaluation", "select raise(ignore) where new.pair % 3 = 0")),
    "trigger after insert": ("t_mine", trigger(
        "after insert on", "evaluation",
        "update evaluation set score = -score where candidate = new.candidate and pair = new.pair")),
    "trigger before update": ("t_mine", trigger(
        "before update on", "design", "select raise(ignore) where new.used > 700")),
    "trigger after update": ("t_mine", trigger(
        "after update of used on", "design", "delete from race_step where step = (select max(step) from race_step)")),
    "trigger before delete": ("t_mine", trigger("before delete on", "evaluation", "select raise(ignore)")),
    "trigger after delete": ("t_mine", trigger("after delete on", "evaluation", "delete from elite")),
    "trigger on elites": ("t_mine", trigger(
        "after insert on", "elite", "update elite set candidate = candidate + 1 where rank = new.rank")),
    "trigger instead of insert": ("t_mine", trigger("instead of insert on", "v_designs", "delete from evaluation")),
    "trigger instead of update": ("t_mine", trigger("instead of update on", "v_designs", "delete from evaluation")),
    "trigger instead of delete": ("t_mine", trigger("instead of delete on", "v_designs", "delete from evaluation")),
    "another text of a view": ("v_leaderboard", text_replaced("v_leaderboard", r"DESC", "ASC")),
    "an endless view": ("v_designs", view("v_designs", endless)),
    "a view that loads a library": ("v_designs", view("v_designs", values_of("load_extension('/tmp/mine.so')"))),
    "a view that writes a file": ("v_designs", view("v_designs", values_of("writefile('/tmp/mine', 'x')"))),
    "a view that edits": ("v_designs", view("v_designs", values_of("edit('x', 'touch /tmp/mine')"))),
    "a view more": ("v_mine", statements("create view v_mine as select 1 as one")),
    "a view less": ("v_convergence", statements("drop view v_convergence")),
    "a table in place of a view": ("v_designs", statements(
        "create table kept as select * from v_designs", "drop view v_designs", "alter table kept rename to v_designs")),
    "a column more": ("evaluation", statements("alter table evaluation add column remark text")),
    "a generated column": ("evaluation", statements(
        "alter table evaluation add column twice real generated always as (2 * score)")),
    "a column less": ("worker", statements(
        "drop view v_workers", "drop view v_failures", "drop view v_attempts", "drop view v_evaluations",
        "alter table worker drop column cpu")),
    "a renamed column": ("evaluation", statements("alter table evaluation rename column wall_us to wall")),
    "columns in another order": ("elimination", made_anew(
        "elimination", r"iteration INTEGER NOT NULL,\s*step      INTEGER NOT NULL,",
        "step INTEGER NOT NULL, iteration INTEGER NOT NULL,")),
    "another type": ("race_step", text_replaced("race_step", r"mean_best    REAL NOT NULL", "mean_best TEXT NOT NULL")),
    "no type at all": ("evaluation", text_replaced("evaluation", r"\) STRICT, WITHOUT ROWID", ") WITHOUT ROWID")),
    "a constraint less": ("elite", text_replaced("elite", r"mean      REAL NOT NULL", "mean REAL")),
    "a check that calls": ("evaluation", text_replaced(
        "evaluation", r"score        REAL", "score REAL CHECK (abs(score) >= 0)")),
    "a default that calls": ("event", text_replaced("event", r"DEFAULT \(strftime\([^)]*\)\)", "DEFAULT (random())")),
    "another foreign key": ("candidate_totals", text_replaced(
        "candidate_totals", r"REFERENCES candidate \(id\)", "REFERENCES candidate (id) ON DELETE CASCADE")),
    "with row ids": ("pair", made_anew("pair", r"STRICT, WITHOUT ROWID", "STRICT")),
    "another collation": ("design", text_replaced("design", r"mission    TEXT NOT NULL", "mission TEXT NOT NULL COLLATE NOCASE")),
    "an index less": ("race_step_of_iteration", statements("drop index race_step_of_iteration")),
    "an index more": ("i_mine", statements("create index i_mine on evaluation (score)")),
    "a unique index": ("i_mine", statements("create unique index i_mine on worker (host, pid, identity)")),
    "an index of an expression": ("i_mine", statements("create index i_mine on evaluation (abs(score))")),
    "an index of a part": ("i_mine", statements("create index i_mine on evaluation (pair) where score > 0")),
    "a table more": ("notes", statements("create table notes (text)", "insert into notes values ('mine')")),
    "a table of text search": ("notes", statements(
        "create virtual table notes using fts5 (text)", "insert into notes values ('mine')")),
    "a table of rectangles": ("boxes", statements("create virtual table boxes using rtree (id, a, b)")),
    "a table of pages": ("pages", statements("create virtual table pages using dbstat")),
    "a name that looks like ours": ("Evaluation_", statements("create table Evaluation_ (candidate, score)")),
    "counted ids": ("mine", statements("create table mine (id integer primary key autoincrement)")),
}
#: The header says it: whose file it is, and how old.
HEADERS = {
    "another program's": ("another program", statements("pragma application_id = 1")),
    "a later version": ("schema 999", statements("pragma user_version = 999")),
    "an earlier version": ("real_log", statements("pragma user_version = 5")),
}
#: What ordinary clients leave behind, which says nothing about rows.
HARMLESS = {"statistics": ("sqlite_stat1", statements("analyze"))}


def make_foreign(store, change):
    """Changes a store that no process has open."""
    with contextlib.closing(sqlite3.connect(store, isolation_level=None)) as db:
        db.execute("pragma foreign_keys = off")
        change(db)
        db.execute("pragma wal_checkpoint(truncate)")
