" Highlighting of .swarm files. Contextual keywords are matched with the token after them.
if exists("b:current_syntax")
  finish
endif

syn match swarmType "\<\h\w*/\h\w*\>"
syn match swarmFunction "\%(\<\%(function\|do\)\)\@<=\s\+\h[A-Za-z0-9_.]*"
syn match swarmArrow "->\|=>"
" Field names may be keywords: a word after a dot, or before a colon or an equals sign.
syn match swarmField "\.\s*\%(done\>\)\@!\h\w*"
" A wall has no name.
syn match swarmField "\%(\s\|[({,]\_s*\)\%(wall\s*:\s*(\)\@!\h\w*\ze\s*\%(:\|=>\|=[^=]\)"
" So may ports.
syn match swarmField "\%(\<connect\)\@<=\s\+\h\w*\ze\s*->"
syn match swarmField "\%(\<connect\>.*->\)\@<=\s\+\h\w*\ze\s*\%($\|[;}/]\)"

" made by `make parser`
syn keyword swarmDeclaration action actuator behavior choice communication connect const controller
syn keyword swarmDeclaration endless entry enum environment event exit extends final fitness
syn keyword swarmDeclaration function history initial inout member message operation optimize out
syn keyword swarmDeclaration parallel param property region self sensor service state statemachine
syn keyword swarmDeclaration struct swarm type var virtual
syn keyword swarmInclude import package
syn keyword swarmStatement after do done else gives in monitor on send
syn keyword swarmOutcome aborted preempted succeeded
syn keyword swarmOperator and not or
syn keyword swarmBoolean false true
syn keyword swarmType bool byte char int8 uint8 int16 uint16 int32 uint32 int64 uint64 float32
syn keyword swarmType float64 string wstring time duration
syn match swarmDeclaration #\<abstraction\>\ze[ \t]*[{]#
syn match swarmDeclaration #\<again\>\ze[ \t]*[(*A-Za-z_0-9"]#
syn match swarmDeclaration #\<all\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<always\>\ze[ \t]*\%(possible\)\>#
syn match swarmDeclaration #\<append\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<area\>\ze[ \t]*[A-Za-z_]#
syn match swarmStatement #\<as\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<at\>\ze[ \t]*\%(\%(all\|least\|most\|random\)\>\|[(]\)#
syn match swarmDeclaration #\<battery\>\ze[ \t]*[{]#
syn match swarmDeclaration #\<before\>\ze[ \t]*[(*A-Za-z_0-9"]#
syn match swarmStatement #\<best\>\ze[ \t]*\%(effort\)\>#
syn match swarmDeclaration #\<between\>\ze[ \t]*[(*A-Za-z_0-9"]#
syn match swarmDeclaration #\<body\>\ze[ \t]*[{]#
syn match swarmStatement #\<by\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<call\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<cancel\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<cancels\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<clear\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<contract\>\ze[ \t]*[A-Za-z_]#
syn match swarmStatement #\<count\>\ze[ \t]*\%(\%(of\)\>\|[(]\)#
syn match swarmDeclaration #\<covered\>\ze[ \t]*[(]#
syn match swarmDeclaration #\<dead\>\ze[ \t]*\%(call\)\>#
syn match swarmStatement #\<deadline\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<deep\>\ze[ \t]*\%(history\)\>#
syn match swarmDeclaration #\<defer\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<distance\>\ze[ \t]*[(]#
syn match swarmDeclaration #\<each\>\ze[ \t]*[A-Za-z_]#
syn match swarmStatement #\<effort\>\ze[ \t]*\%([,;}]\|$\)#
syn match swarmDeclaration #\<ends\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<energy\>\ze[ \t]*[(]#
syn match swarmStatement #\<evaluations\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<eventually\>\ze[ \t]*[(*A-Za-z_0-9"]#
syn match swarmDeclaration #\<feedback\>\ze[ \t]*[{]#
syn match swarmDeclaration #\<found\>\ze[ \t]*[(]#
syn match swarmDeclaration #\<from\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<goal\>\ze[ \t]*[{]#
syn match swarmDeclaration #\<has\>\ze[ \t]*[\[]#
syn match swarmDeclaration #\<hears\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<heartbeat\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<height\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmStatement #\<internal\>\ze[ \t]*\%(\%(after\|monitor\|on\)\>\|[\[]\)#
syn match swarmStatement #\<keep\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmStatement #\<latest\>\ze[ \t]*\%([,;}]\|$\)#
syn match swarmDeclaration #\<leads\>\ze[ \t]*\%(to\)\>#
syn match swarmDeclaration #\<least\>\ze[ \t]*[0-9"]#
syn match swarmStatement #\<lifespan\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<lost\>\ze[ \t]*\%(after\)\>#
syn match swarmDeclaration #\<max\>\ze[ \t]*\%(count\|each\)\>#
syn match swarmStatement #\<maximize\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<mean\>\ze[ \t]*\%(count\|each\)\>#
syn match swarmDeclaration #\<min\>\ze[ \t]*\%(count\|each\)\>#
syn match swarmStatement #\<minimize\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<model\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<most\>\ze[ \t]*[0-9"]#
syn match swarmDeclaration #\<neighbors\>\ze[ \t]*\%(within\)\>#
syn match swarmDeclaration #\<never\>\ze[ \t]*[(*A-Za-z_0-9"]#
syn match swarmDeclaration #\<no\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<obstacle\>\ze[ \t]*[A-Za-z_]#
syn match swarmStatement #\<of\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<only\>\ze[ \t]*\%(after\)\>#
syn match swarmDeclaration #\<operator\>\ze[ \t]*\%(event\)\>#
syn match swarmDeclaration #\<other\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<possible\>\ze[ \t]*[(*A-Za-z_0-9"]#
syn match swarmDeclaration #\<radio\>\ze[ \t]*[{]#
syn match swarmDeclaration #\<radius\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<rain\>\ze[ \t]*\%(from\|until\)\>#
syn match swarmDeclaration #\<random\>\ze[ \t]*\%(in\)\>#
syn match swarmDeclaration #\<reach\>\ze[ \t]*[A-Za-z_]#
syn match swarmStatement #\<reliable\>\ze[ \t]*\%([,;}]\|$\)#
syn match swarmDeclaration #\<remove\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<request\>\ze[ \t]*[{]#
syn match swarmDeclaration #\<response\>\ze[ \t]*[{]#
syn match swarmDeclaration #\<result\>\ze[ \t]*[{]#
syn match swarmInclude #\<ros\>\ze[ \t]*[0-9"]#
syn match swarmStatement #\<seed\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<sends\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<senses\>\ze[ \t]*[A-Za-z_]#
syn match swarmStatement #\<size\>\ze[ \t]*[0-9"]#
syn match swarmDeclaration #\<some\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<starts\>\ze[ \t]*[A-Za-z_]#
syn match swarmStatement #\<step\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmStatement #\<steps\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmStatement #\<subject\>\ze[ \t]*\%(to\)\>#
syn match swarmDeclaration #\<sum\>\ze[ \t]*\%(each\)\>#
syn match swarmDeclaration #\<target\>\ze[ \t]*[A-Za-z_]#
syn match swarmDeclaration #\<then\>\ze[ \t]*[(*A-Za-z_0-9"]#
syn match swarmDeclaration #\<time\>\ze[ \t]*\%(\%(until\)\>\|[(]\)#
syn match swarmDeclaration #\<times\>\ze[ \t]*\%([,;}]\|$\)#
syn match swarmStatement #\<to\>\ze[ \t]*[(*A-Za-z_0-9"-]#
syn match swarmDeclaration #\<total\>\ze[ \t]*[(]#
syn match swarmDeclaration #\<until\>\ze[ \t]*[(*A-Za-z_0-9"-]#
syn match swarmDeclaration #\<wall\>\ze[ \t]*[:]#
syn match swarmDeclaration #\<when\>\ze[ \t]*\%(dead\)\>#
syn match swarmDeclaration #\<where\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<wind\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmDeclaration #\<within\>\ze[ \t]*[A-Za-z_0-9"-]#
syn match swarmStatement #\<world\>\ze[ \t]*[0-9"]#
syn match swarmStatement #\<x\>\ze[ \t]*[0-9"]#
syn match swarmDeclaration #\<zone\>\ze[ \t]*[A-Za-z_]#
syn match swarmName #\%(\<\%(actuator\|choice\|communication\|const\|controller\|enum\|environment\|event\|final\|fitness\|history\|member\|model\|operation\|property\|region\|sensor\|state\|statemachine\|struct\|type\|virtual\)\)\@<=\s\+\h\w*#
" end

syn match swarmNumber "\<\d\+\%(\.\d\+\)\=\%([eE][+-]\=\d\+\)\=\%(\s*\%(us\|ms\|s\|min\|h\|km\|cm\|mm\|m\)\>\)\="
syn match swarmBadEscape "\\." contained
syn match swarmEscape "\\\%(["\\nrt]\|u\x\{4}\|U\x\{8}\)" contained
syn region swarmString start=+"+ skip=+\\.+ end=+"+ oneline contains=swarmEscape,swarmBadEscape,@Spell
syn keyword swarmTodo TODO FIXME XXX contained
syn match swarmComment "//.*$" contains=swarmTodo,@Spell
syn match swarmDoc "^\s*\zs///\%([^/].*\)\=$" contains=@Spell
syn region swarmComment start="/\*" end="\*/" contains=swarmTodo,@Spell

hi def link swarmDeclaration Keyword
hi def link swarmStatement Statement
hi def link swarmInclude Include
hi def link swarmOutcome Constant
hi def link swarmOperator Operator
hi def link swarmArrow Operator
hi def link swarmBoolean Boolean
hi def link swarmType Type
hi def link swarmFunction Function
hi def link swarmName Identifier
hi def link swarmNumber Number
hi def link swarmString String
hi def link swarmEscape SpecialChar
hi def link swarmBadEscape Error
hi def link swarmComment Comment
hi def link swarmDoc SpecialComment
hi def link swarmTodo Todo

let b:current_syntax = "swarm"
