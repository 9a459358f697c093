" Comments, indentation, folding by syntax on demand.
if exists("b:did_ftplugin")
  finish
endif
let b:did_ftplugin = 1

setlocal commentstring=//\ %s comments=s1:/*,mb:*,ex:*/,:///,://
setlocal expandtab shiftwidth=2 softtabstop=2 textwidth=100 smartindent
setlocal formatoptions-=t formatoptions+=croql suffixesadd=.swarm
let b:undo_ftplugin = "setlocal cms< com< et< sw< sts< tw< si< fo< sua<"
