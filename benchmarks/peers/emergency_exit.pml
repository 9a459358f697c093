/* examples/emergency_exit without time: N robots, and at most K of `SawExit` on the way to each. */
#ifndef N
#define N 6
#endif
#define K 2

mtype = { Calm, Search, Leaving, Safe };
mtype at[N];
byte waiting[N];

inline tell(me) {
  other = 0;
  do
  :: other < N ->
     if
     :: other != me && at[other] != Safe && waiting[other] < K -> waiting[other]++
     :: else
     fi;
     other++
  :: else -> break
  od;
  other = 0
}

proctype robot(byte i) {
  byte other = 0;
  do
  :: atomic { at[i] == Calm -> at[i] = Search }
  :: atomic { at[i] == Calm && waiting[i] > 0 -> waiting[i]-- }
  :: atomic { at[i] == Search -> at[i] = Leaving; tell(i) }
  :: atomic { at[i] == Search && waiting[i] > 0 -> waiting[i]--; at[i] = Leaving }
  :: atomic { at[i] == Leaving && waiting[i] > 0 -> waiting[i]-- }
  :: atomic { at[i] == Leaving -> at[i] = Safe; waiting[i] = 0 }
  :: atomic { at[i] == Leaving -> at[i] = Search }
  od
}

init {
  byte k = 0;
  atomic {
    do
    :: k < N -> at[k] = Calm; k++
    :: else -> break
    od;
    k = 0;
    do
    :: k < N -> run robot(k); k++
    :: else -> break
    od
  }
}
